#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/task.h"

namespace prospect::tasks {

/// Why no plan of a table can be complete.
struct PlanDefect {
  int action = -1;   ///< that it is about; -1: of the plan length
  std::string what;  ///< in words, with what helps
};

/// Looks whether every action that may come leads on to one that completes a plan (after which one
/// begins anew or nothing follows, planner::TaskRules), and whether a plan may have each of
/// `lengths` actions. Pure.
std::optional<PlanDefect> FindPlanDefect(const sim::TaskSpec& spec,
                                         const std::vector<int>& lengths);

/// Actions after which a plan may be complete. Ascending.
std::vector<int> Completing(const sim::TaskSpec& spec);

/// Actions that no plan can come to. Ascending.
std::vector<int> NeverReached(const sim::TaskSpec& spec);

}  // namespace prospect::tasks
