#pragma once

#include <string>
#include <vector>

#include "model/training/train_config.h"

namespace prospect::model {

/// One thing in which a task's configuration goes beyond the paper, and which can be left out.
struct RecipeStep {
  std::string name;  ///< as --without takes it
  std::string what;  ///< one line
};

const std::vector<RecipeStep>& RecipeSteps();

/// Leaves one step out; T's updates stay as many as they were. No change where the configuration
/// has not got it. Throws std::invalid_argument that lists the known names.
void LeaveOut(const std::string& step, TrainConfig* config);

/// "best": the configuration as it is; "paper": all steps left out. Throws std::invalid_argument
/// for another name.
void ApplyRecipe(const std::string& recipe, TrainConfig* config);

}  // namespace prospect::model
