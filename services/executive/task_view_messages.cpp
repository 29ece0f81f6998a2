#include "services/executive/task_view_messages.h"

#include "services/binding/task_messages.h"
#include "services/executive/known_task.h"

namespace prospect::services {

agent::TaskView TaskViewOf(const task_t& task, const std::string& wish) {
  agent::TaskView view;
  view.name = task.name;
  view.world_version = task.world_version;
  for (const action_t& action : task.actions) view.actions.push_back(action.name);
  view.words = WordsFromTask(task);
  view.rules = RulesFromTask(task);
  if (const auto file = KnownTask(wish, task)) view.goals = file->goals;
  for (const cause_t& cause : task.causes) view.causes[cause.name] = cause.words;
  if (task.tick_seconds > 0) view.frames_per_second = 1 / task.tick_seconds;
  return view;
}

agent::SceneLabel SceneLabelOf(const label_t& label) {
  agent::SceneLabel scene;
  scene.seed = label.seed;
  for (const auto present : label.present) scene.present.push_back(present == 1);
  return scene;
}

}  // namespace prospect::services
