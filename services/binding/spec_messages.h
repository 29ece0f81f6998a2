#pragma once

#include "lcmtypes/messages.h"
#include "sim/task.h"

namespace prospect::services {

/// TASK as a task's specification, which task files and data sets are compared with; what TASK does
/// not say (landmarks, the world's step) stays empty. Pure.
sim::TaskSpec SpecFromTask(const task_t& task);

}  // namespace prospect::services
