#pragma once

#include <string>

#include "cli/options/task.h"
#include "tools/common/task_training.h"

namespace prospect::model {

// What a built-in task is trained with.
inline TrainConfig TrainConfigFor(const std::string& task) {
  return tools::TrainConfigOf(cli::TaskOf(task));
}

}  // namespace prospect::model
