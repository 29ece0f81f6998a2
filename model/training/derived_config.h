#pragma once

#include <cstddef>

#include "model/training/train_config.h"

namespace prospect::model {

/// What a data set and its task are to a training run.
struct TrainingSize {
  int image_width = 64;
  int image_height = 64;
  int num_actions = 1;
  int plan_length = 1;
  std::size_t segments = 0;  ///< actions that were carried out; 0: nobody knows yet
};

/// The configuration for a task without settings of its own. What does not depend on sizes is what
/// served the built-in tasks; iterations grow with the number of actions that were recorded, so
/// that each is seen some dozens of times, between bounds. Valid. Pure.
TrainConfig DerivedConfig(const TrainingSize& size);

}  // namespace prospect::model
