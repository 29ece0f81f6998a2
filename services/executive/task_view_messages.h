#pragma once

#include <string>

#include "agent/task_view.h"
#include "lcmtypes/messages.h"

namespace prospect::services {

// TASK and LABEL as the agent sees them. Pure functions, safe from any thread.

/// @param wish of the task's file, as of --task; without a file there are no goals. Throws as
/// RulesFromTask and KnownTask.
agent::TaskView TaskViewOf(const task_t& task, const std::string& wish);

agent::SceneLabel SceneLabelOf(const label_t& label);

}  // namespace prospect::services
