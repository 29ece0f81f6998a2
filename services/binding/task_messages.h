#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lcmtypes/messages.h"
#include "planner/goal.h"
#include "planner/handovers.h"
#include "planner/path.h"
#include "planner/task_rules.h"

namespace prospect::services {

// TASK as the libraries see it. Pure functions, safe from any thread.

/// Hash of everything in TASK but utime, the hash itself and causes, which decide nothing.
/// SEARCH_ROOT carries it, so that a worker that missed a TASK (another plan length, say) waits for
/// the right one instead of searching by the wrong rules.
std::int64_t TaskHash(const task_t& task);

/// The planner's rules: action table size, plan length, what may follow what, and in which order a
/// tower grows. Row num_actions of `successors` (the start) comes from `initial`. Throws
/// std::runtime_error when an index lies outside the table; messages that passed ValidateMessage
/// never do.
planner::TaskRules RulesFromTask(const task_t& task);

/// The table's words: kind and object of each action.
std::vector<planner::ActionWords> WordsFromTask(const task_t& task);

/// The names of a path's actions: "align(green), grasp(green)".
std::string NamesOf(const task_t& task, const planner::Path& path);

/// The rules of one search: the task's, with the plan length and the goal of its SEARCH_ROOT, which
/// the task's own plans can bring about (prepared then). Throws as RulesFromTask, and
/// planner::GoalError when the goal is no goal or not one of this task.
planner::TaskRules RulesOfSearch(const task_t& task, const search_root_t& root);

}  // namespace prospect::services
