#pragma once

#include "planner/task_rules.h"
#include "sim/task.h"

namespace prospect::sim {

// A task's table as planner/ has it, with the order in which a tower grows where the task builds
// one. Not prepared; whoever wants a goal, too, sets it (planner/goal.h), which prepares. A pure
// function.
planner::TaskRules PlanRules(const TaskSpec& spec);

}  // namespace prospect::sim
