#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "planner/goal_fact.h"
#include "tasks/action_table.h"

namespace prospect::tasks {

/// The facts that the section "goals" of a file can ask for, for all objects that its forms may be
/// about:
///
///     on(A,B):                             # A and B stand for any objects
///       by: lift(A) then align_over(B)     # an action, or one directly after another
///       undone_by: lift(A) then align_over(any)
///
/// A fact that no plan could bring about is left out. @param successors as of sim::TaskSpec.
/// Throws TaskFileError.
std::vector<planner::GoalFact> ReadGoals(const std::string& file, const YAML::Node& node,
                                         const ActionTable& table,
                                         const std::vector<std::vector<int>>& successors);

}  // namespace prospect::tasks
