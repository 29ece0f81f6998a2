#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/training/train_config.h"

namespace prospect::model {

/// What a training run was asked to change of a task's own configuration.
struct ConfigChoices {
  TrainConfig task;                                   ///< the task's own
  nlohmann::json changes = nlohmann::json::object();  ///< of --config
  bool paper = false;                                 ///< all steps beyond the paper are left out
  std::vector<std::string> without;                   ///< or these
  std::int64_t iterations = 0;  ///< of T, all others in proportion; 0: as they are
  std::string variant;          ///< empty: none
  bool finetune = false;
  std::string precision;   ///< empty: as it is
  std::string labels;      ///< empty: as they are
  std::int64_t seed = -1;  ///< -1: as it is
};

/// The configuration that all choices lead to, in this order: the task's, `changes`, steps left
/// out, iterations, variant (so that all variants share what comes before T), the rest. It is
/// valid as a whole, whichever choices met: throws std::invalid_argument naming what is not.
TrainConfig ConfigOf(const ConfigChoices& choices);

}  // namespace prospect::model
