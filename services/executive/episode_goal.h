#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lcmtypes/messages.h"
#include "planner/goal.h"

namespace prospect::services {

/// What a person wants of one episode beyond the task's own success. Empty: nothing. Plain data and
/// pure functions, safe from any thread.
class EpisodeGoal {
 public:
  /// @param text as planner::ParseGoal reads it; empty: no goal. Throws std::invalid_argument.
  explicit EpisodeGoal(const std::string& text);

  bool empty() const { return atoms_.empty(); }
  /// One atom a string, as SEARCH_ROOT carries them.
  std::vector<std::string> Atoms() const;
  /// Why the task, or the scene that `label` tells of, cannot have it; empty: nothing is known
  /// against it.
  std::string Defect(const task_t& task, const std::optional<label_t>& label) const;
  /// Makes `rules` ask for it and prepares them. Throws planner::GoalError where Defect says why.
  void Set(const task_t& task, planner::TaskRules* rules) const;
  /// Whether the actions carried out, in turn, brought it about. True where there is no goal.
  bool Reached(const task_t& task, const planner::Path& executed) const;

 private:
  std::vector<planner::GoalAtom> atoms_;
};

}  // namespace prospect::services
