#pragma once

#include <optional>
#include <string>
#include <vector>

#include "agent/task_view.h"
#include "planner/goal.h"

namespace prospect::agent {

/// What a person wants of one episode beyond the task's own success. Empty: nothing. Plain data and
/// pure functions, safe from any thread.
class EpisodeGoal {
 public:
  /// @param text as planner::ParseGoal reads it; empty: no goal. Throws std::invalid_argument.
  explicit EpisodeGoal(const std::string& text);

  bool empty() const { return atoms_.empty(); }
  /// One atom a string, as it was said.
  std::vector<std::string> Atoms() const;
  /// The same as the task has it: of visited(a,b) one for each. Throws planner::GoalError.
  std::vector<std::string> AtomsOf(const TaskView& task) const;
  /// For whoever searches without knowing the task's goals (planner::ToString(GoalTerm)), one an
  /// atom. Throws planner::GoalError.
  std::vector<std::string> TermsFor(const TaskView& task) const;
  /// Why the task, or the scene that `label` tells of, cannot have it; empty: nothing is known
  /// against it.
  std::string Defect(const TaskView& task, const std::optional<SceneLabel>& label) const;
  /// The task's rules with it, prepared. Throws planner::GoalError where Defect says why.
  planner::TaskRules RulesFor(const TaskView& task) const;
  /// Whether the actions carried out, in turn, brought it about. True where there is no goal.
  bool Reached(const TaskView& task, const planner::Path& executed) const;

 private:
  std::vector<planner::GoalAtom> atoms_;
};

}  // namespace prospect::agent
