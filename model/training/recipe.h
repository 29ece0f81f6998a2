#pragma once

#include <string>
#include <vector>

#include "model/training/train_config.h"

namespace prospect::model {

/// The names, as --without takes them, of what goes beyond the paper in a task's configuration and
/// can be left out; `prospect train --help` says what each is (cli/commands/train.cpp).
const std::vector<std::string>& RecipeSteps();

/// Leaves one step out; T's updates stay as many as they were. No change where the configuration
/// has not got it. Throws std::invalid_argument that lists the known names.
void LeaveOut(const std::string& step, TrainConfig* config);

/// Leaves all of them out: what remains is the paper's.
void LeaveOutAll(TrainConfig* config);

}  // namespace prospect::model
