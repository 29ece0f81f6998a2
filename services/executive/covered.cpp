#include "services/executive/covered.h"

#include <set>

#include "planner/tower.h"
#include "services/binding/task_messages.h"

namespace prospect::services {

model::SceneKind KindOf(const task_t& task, const label_t* label) {
  model::SceneKind kind;
  kind.plan_length = task.plan_length;
  planner::TaskRules rules = RulesFromTask(task);
  rules.Prepare();
  kind.tower = planner::TowerLevels(rules);
  if (label == nullptr) return kind;
  std::set<std::string> objects;
  for (std::size_t i = 0; i < task.actions.size() && i < label->present.size(); ++i) {
    if (label->present[i] == 1) objects.insert(task.actions[i].object);
  }
  kind.objects = static_cast<int>(objects.size());
  return kind;
}

}  // namespace prospect::services
