#pragma once

#include <vector>

#include "lcmtypes/messages.h"
#include "planner/evaluation.h"
#include "planner/path.h"

namespace prospect::services {

// Paths and evaluations between the wire and the planner. Pure functions, safe from any thread.

path_t ToMessage(const planner::Path& path);
planner::Path FromMessage(const path_t& message);
std::vector<planner::Path> FromMessages(const std::vector<path_t>& messages);

/// EVALUATION of `path`: V and f rounded to the grid of 1/65535, Q and p of the `allowed` actions
/// (ascending) as 16 bits.
evaluation_t ToMessage(const planner::Path& path, const planner::Evaluation& evaluation,
                       const std::vector<int>& allowed);

/// The planner's form; Q and p of actions that are not listed are 0. Actions at or beyond
/// `num_actions` are left out.
planner::Evaluation FromMessage(const evaluation_t& message, int num_actions);

}  // namespace prospect::services
