#include "agent/task_view.h"

#include "planner/tower.h"

namespace prospect::agent {

std::string TaskView::ActionName(int action) const {
  const auto index = static_cast<std::size_t>(action);
  return index < actions.size() ? actions[index] : "action " + std::to_string(action);
}

std::string TaskView::NamesOf(const planner::Path& path) const {
  std::string names;
  for (const int action : path) names += (names.empty() ? "" : ", ") + ActionName(action);
  return names;
}

std::string TaskView::CauseWords(const std::string& cause) const {
  const auto known = causes.find(cause);
  return known == causes.end() ? cause : known->second;
}

std::set<std::string> ObjectsPresent(const TaskView& task, const SceneLabel& label) {
  std::set<std::string> objects;
  for (std::size_t i = 0; i < task.words.size() && i < label.present.size(); ++i) {
    if (label.present[i]) objects.insert(task.words[i].object);
  }
  return objects;
}

model::SceneKind KindOf(const TaskView& task, const SceneLabel* label) {
  model::SceneKind kind;
  kind.plan_length = task.rules.plan_length;
  planner::TaskRules rules = task.rules;
  rules.Prepare();
  kind.tower = planner::TowerLevels(rules);
  if (label != nullptr) kind.objects = static_cast<int>(ObjectsPresent(task, *label).size());
  return kind;
}

}  // namespace prospect::agent
