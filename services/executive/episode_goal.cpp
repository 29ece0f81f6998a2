#include "services/executive/episode_goal.h"

#include <set>

#include "services/binding/task_messages.h"

namespace prospect::services {
namespace {

std::string Listed(const std::set<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Objects of the table that LABEL says are in the scene.
std::set<std::string> Present(const task_t& task, const label_t& label) {
  std::set<std::string> present;
  for (std::size_t i = 0; i < task.actions.size() && i < label.present.size(); ++i) {
    if (label.present[i] == 1) present.insert(task.actions[i].object);
  }
  return present;
}

}  // namespace

EpisodeGoal::EpisodeGoal(const std::string& text) {
  if (!text.empty()) atoms_ = planner::ParseGoal(text);
}

std::vector<std::string> EpisodeGoal::Atoms() const {
  std::vector<std::string> atoms;
  for (const auto& atom : atoms_) atoms.push_back(planner::ToString(atom));
  return atoms;
}

std::string EpisodeGoal::Defect(const task_t& task, const std::optional<label_t>& label) const {
  if (empty()) return "";
  try {
    auto rules = RulesFromTask(task);
    planner::SetGoal(atoms_, WordsFromTask(task), &rules);
  } catch (const planner::GoalError& error) {
    return error.what();
  }
  if (!label) return "";
  const auto present = Present(task, *label);
  for (const auto& atom : atoms_) {
    for (const auto& name : atom.arguments) {
      if (name != "*" && !present.count(name))
        return "there is no " + name + " in this scene; there are: " + Listed(present);
    }
  }
  return "";
}

void EpisodeGoal::Set(const task_t& task, planner::TaskRules* rules) const {
  planner::SetGoal(atoms_, WordsFromTask(task), rules);
}

bool EpisodeGoal::Reached(const task_t& task, const planner::Path& executed) const {
  if (empty()) return true;
  auto rules = RulesFromTask(task);
  Set(task, &rules);
  return rules.GoalMet(executed, {});
}

}  // namespace prospect::services
