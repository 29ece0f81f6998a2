#pragma once

#include <memory>

#include "model/engine.h"
#include "model/novelty.h"
#include "tools/evaluate/decider.h"

namespace prospect::tools {

// Refuses a scene whose first picture is unlike what the networks were trained on: before the first
// action, when the gauge's p-value is below `level` (0: never refuses). Else `inner` decides.
// `engine` outlives it.
std::unique_ptr<Decider> MakeNoveltyGate(std::unique_ptr<Decider> inner, model::Engine* engine,
                                         const model::NoveltyGauge& gauge, double level);

}  // namespace prospect::tools
