#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/trial.h"
#include "planner/task_rules.h"

namespace prospect::figures {

/// What a task's actions are called and what may follow what. A plain value.
struct TaskTable {
  planner::TaskRules rules;
  std::string hash;                ///< as data sets and weights store it
  std::vector<std::string> names;  ///< for people: "align over red"

  const std::string& Name(int action) const { return names.at(static_cast<std::size_t>(action)); }
  /// The actions that may come next in a plan, leaving out those that begin it anew
  /// (sim::IsRetry): a plan is shown as if it went well.
  std::vector<int> Onward(const planner::Path& path) const;
};

/// The table of gestures for the tasks that have them (model/jigsaws/gestures.h), else that of one
/// of sim/'s tasks. Throws std::invalid_argument, naming the tasks that there are.
TaskTable TableOf(const std::string& task);

/// The same for plans as long as this trial's. Throws model::DataError if that is no length.
TaskTable TableFor(const TaskTable& table, const model::Trial& trial);

/// `count` actions drawn one after the other, each uniform among those that the task's graph lets
/// follow the one before; from the start again where nothing may follow. A function of `seed`.
std::vector<int> RandomWalk(const planner::TaskRules& rules, int count, std::uint64_t seed);

}  // namespace prospect::figures
