#pragma once

#include <memory>
#include <string>

#include "model/training/context.h"
#include "model/training/stage.h"

namespace prospect::model {

/// Trains a classifier on goal pictures: which action led here (cross-entropy). Only segments that
/// succeeded: where one failed, the picture does not show its action's goal. `name` also seeds its
/// batches, so the two classifiers see different ones.
std::unique_ptr<Stage> MakeClassifierStage(const TrainContext& context, Classifier classifier,
                                           const std::string& name);

/// Trains f_enc and f_dec together: L1 between a picture and its reconstruction (paper §III-A),
/// pixels weighted by TrainConfig::focus.
std::unique_ptr<Stage> MakeEncoderDecoderStage(const TrainContext& context);

}  // namespace prospect::model
