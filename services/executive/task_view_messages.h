#pragma once

#include "agent/task_view.h"
#include "lcmtypes/messages.h"

namespace prospect::services {

// TASK and LABEL as the agent sees them. Pure functions, safe from any thread.

/// Throws as RulesFromTask.
agent::TaskView TaskViewOf(const task_t& task);

agent::SceneLabel SceneLabelOf(const label_t& label);

}  // namespace prospect::services
