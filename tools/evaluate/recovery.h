#pragma once

#include <cstdint>
#include <optional>

#include "sim/oracle.h"
#include "sim/task.h"

namespace prospect::tools {

// Whether an episode's plan was lost on the way (a block slipped, say), and whether somebody who
// may try everything would still have finished by beginning anew from there.
struct Recovery {
  sim::SceneClass anew = sim::SceneClass::kDoubtful;  // what the oracle says of plans begun anew
  double time = 0;                                    // simulated seconds since the start
};

// Judges `task` where a plan may be begun anew (TaskSpec::IsRetry): nothing elsewhere, or where
// going on as planned still succeeds in any of three runs with fresh noise. What can be tried is
// what the world's own limits of time and actions leave. The task is left as it was.
std::optional<Recovery> ConsultRecovery(sim::Task& task, std::uint64_t scene_seed);

}  // namespace prospect::tools
