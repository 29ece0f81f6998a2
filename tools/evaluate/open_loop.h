#pragma once

#include <memory>

#include "tools/evaluate/decider.h"

namespace prospect::tools {

// Carries the plan that `inner` finds from the first picture out as it is, without looking again;
// nothing is planned anew. Who gives no whole plan (Decision::plan) is asked each time. An episode
// that goes on after the plan is stopped there.
std::unique_ptr<Decider> MakeOpenLoop(std::unique_ptr<Decider> inner);

}  // namespace prospect::tools
