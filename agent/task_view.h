#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "model/refusal/scene_kind.h"
#include "planner/goal_fact.h"
#include "planner/handovers.h"
#include "planner/path.h"
#include "planner/task_rules.h"

namespace prospect::agent {

/// A task as the agent knows it: what can be done, and what may go wrong. Plain data; const member
/// functions are safe from any thread.
struct TaskView {
  std::string name;                           ///< "stacking"
  std::string world_version;                  ///< names the world's constants
  std::vector<std::string> actions;           ///< by index: "grasp(green)"
  std::vector<planner::ActionWords> words;    ///< kind and object of each
  planner::TaskRules rules;                   ///< what may follow what; without a goal
  std::vector<planner::GoalFact> goals;       ///< what may be asked for; none: nothing
  std::map<std::string, std::string> causes;  ///< of failures, by name; in words for people
  double frames_per_second = 10;              ///< pictures, in simulated time

  /// "grasp(green)"; "action 99" where the table has none.
  std::string ActionName(int action) const;
  /// "align(green), grasp(green)".
  std::string NamesOf(const planner::Path& path) const;
  /// A cause in words; one that the table does not have as it is.
  std::string CauseWords(const std::string& cause) const;
};

/// What is said of a scene by whoever has set it up. Plain data.
struct SceneLabel {
  std::int64_t seed = -1;     ///< of a simulated scene; -1: it was not made from one
  std::vector<bool> present;  ///< by action: its object is there
};

/// The things that actions are about and that are there.
std::set<std::string> ObjectsPresent(const TaskView& task, const SceneLabel& label);

/// What kind of scene it is; without a label, the objects are not known.
model::SceneKind KindOf(const TaskView& task, const SceneLabel* label);

}  // namespace prospect::agent
