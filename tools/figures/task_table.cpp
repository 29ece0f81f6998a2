#include "tools/figures/task_table.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "base/hash.h"
#include "base/random.h"
#include "model/dataset.h"
#include "model/jigsaws/gestures.h"
#include "sim/task_factory.h"
#include "tools/evaluate/decider.h"

namespace prospect::figures {

namespace {

std::string NameOf(const sim::ActionSpec& action) {
  std::string name = action.kind + " " + action.object;
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Any gesture may follow any other, as far as the table goes: videos of people say no more.
TaskTable GestureTable() {
  TaskTable table;
  table.hash = model::jigsaws::GestureTableHash();
  table.rules.num_actions = model::jigsaws::kGestures;
  table.rules.repeats_allowed = true;
  std::vector<int> all;
  for (int action = 0; action < model::jigsaws::kGestures; ++action) {
    all.push_back(action);
    table.names.push_back(model::jigsaws::GestureName(action) + " " +
                          model::jigsaws::GestureWords(action));
  }
  table.rules.successors.assign(all.size() + 1, all);
  return table;
}

}  // namespace

TaskTable TableOf(const std::string& task) {
  if (model::jigsaws::IsGestureTask(task)) return GestureTable();
  const auto world = sim::MakeTask(task);
  TaskTable table;
  table.rules = tools::RulesOf(world->spec());
  table.hash = base::HexText(world->spec().Hash());
  for (const sim::ActionSpec& action : world->spec().actions) table.names.push_back(NameOf(action));
  return table;
}

TaskTable TableFor(const TaskTable& table, const model::Trial& trial) {
  TaskTable same = table;
  same.rules.plan_length = trial.plan_length;
  try {
    same.rules.Prepare();
  } catch (const std::invalid_argument& error) {
    throw model::DataError("trial of seed " + std::to_string(trial.seed) + ": " + error.what());
  }
  return same;
}

std::vector<int> TaskTable::Onward(const planner::Path& path) const {
  const int before = path.empty() ? rules.num_actions : path.back();
  std::vector<int> onward;
  for (const int action : rules.AllowedActions({}, path)) {
    if (path.empty() || !sim::IsRetry(rules.successors, before, action)) onward.push_back(action);
  }
  return onward;
}

std::vector<int> RandomWalk(const planner::TaskRules& rules, int count, std::uint64_t seed) {
  base::Random random(seed);
  std::vector<int> walk;
  int last = rules.num_actions;
  while (static_cast<int>(walk.size()) < count) {
    const std::vector<int>* next = &rules.successors.at(static_cast<std::size_t>(last));
    if (next->empty()) next = &rules.successors.back();
    last = (*next)[static_cast<std::size_t>(random.Below(static_cast<int>(next->size())))];
    walk.push_back(last);
  }
  return walk;
}

}  // namespace prospect::figures
