#include "services/binding/task_messages.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "planner/attempts.h"
#include "planner/tower.h"
#include "services/binding/search_messages.h"

namespace prospect::services {
namespace {

void Append(const std::vector<std::int32_t>& indices, std::string* text) {
  for (const auto index : indices) *text += std::to_string(index) + ',';
  *text += ';';
}

std::vector<planner::GoalTerm> GoalOf(const search_root_t& root, int num_actions) {
  std::vector<planner::GoalTerm> terms;
  for (const auto& goal : root.goals) terms.push_back(planner::ParseTerm(goal, num_actions));
  return terms;
}

std::vector<int> Checked(const std::vector<std::int32_t>& indices, int num_actions) {
  for (const auto index : indices) {
    if (index < 0 || index >= num_actions) {
      throw std::runtime_error("TASK names action " + std::to_string(index) +
                               " but its table has " + std::to_string(num_actions) +
                               " rows; publish a consistent table");
    }
  }
  return {indices.begin(), indices.end()};
}

}  // namespace

std::int64_t TaskHash(const task_t& task) {
  std::string text = task.name + '|' + task.world_version + '|';
  for (const auto& action : task.actions) {
    text += action.name + '|' + action.kind + '|' + action.object + '|';
    Append(action.successors, &text);
  }
  Append(task.initial, &text);
  text += std::to_string(task.plan_length) + '|' + std::to_string(task.repeats_allowed) + '|';
  text += std::to_string(task.image_width) + 'x' + std::to_string(task.image_height) + '|';
  text += std::to_string(task.tick_seconds) + '|' + std::to_string(task.action_time_limit);
  return static_cast<std::int64_t>(base::HashText(text));
}

planner::TaskRules RulesFromTask(const task_t& task) {
  planner::TaskRules rules;
  rules.num_actions = task.num_actions;
  rules.plan_length = task.plan_length;
  rules.repeats_allowed = task.repeats_allowed != 0;
  for (const auto& action : task.actions) {
    rules.successors.push_back(Checked(action.successors, task.num_actions));
  }
  rules.successors.push_back(Checked(task.initial, task.num_actions));
  rules.tower = planner::OneTower(WordsFromTask(task), rules);
  return rules;
}

std::vector<planner::ActionWords> WordsFromTask(const task_t& task) {
  std::vector<planner::ActionWords> words;
  for (const auto& action : task.actions) words.push_back({action.kind, action.object});
  return words;
}

planner::TaskRules RulesOfSearch(const task_t& task, const search_root_t& root) {
  planner::TaskRules rules = RulesFromTask(task);
  if (root.goals.empty()) {
    rules.plan_length = root.plan_length;
    return rules;
  }
  planner::SetGoal(GoalOf(root, rules.num_actions), &rules);
  return planner::RulesFor(std::move(rules), {{}, root.plan_length});
}

std::string NamesOf(const task_t& task, const planner::Path& path) {
  std::string names;
  for (const std::size_t action : path) {
    const bool known = action < task.actions.size();
    names += (names.empty() ? "" : ", ") +
             (known ? task.actions[action].name : "action " + std::to_string(action));
  }
  return names;
}

}  // namespace prospect::services
