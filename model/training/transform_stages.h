#pragma once

#include <cstdint>
#include <memory>

#include "model/training/context.h"
#include "model/training/stage.h"

namespace prospect::model {

/// How many transforms T's first stage links at an iteration (TrainConfig::linked_from).
int LinkedSteps(const TrainConfig& config, std::int64_t iteration);

/// T against encodings of the goal pictures: sum over linked steps of L1(h_k, f_enc(goal_k)).
/// Beyond the paper: it needs no decoder, so an iteration costs a tenth of the paper's, which then
/// finishes (next stage).
std::unique_ptr<Stage> MakeTransformHiddenStage(const TrainContext& context);

/// The paper's loss (§III-B): linked transforms with shared weights, decoded by the frozen decoder,
/// L1(x1) + L1(x2) + ... + lambda * C's cross-entropy on the second picture (of segments that
/// succeeded).
std::unique_ptr<Stage> MakeTransformImageStage(const TrainContext& context);

}  // namespace prospect::model
