#include "services/binding/spec_messages.h"

namespace prospect::services {

sim::TaskSpec SpecFromTask(const task_t& task) {
  sim::TaskSpec spec;
  spec.name = task.name;
  spec.world_version = task.world_version;
  for (const action_t& action : task.actions) {
    spec.actions.push_back({action.index, action.name, action.kind, action.object});
    spec.successors.emplace_back(action.successors.begin(), action.successors.end());
  }
  spec.successors.emplace_back(task.initial.begin(), task.initial.end());
  spec.plan_length = task.plan_length;
  spec.image_width = task.image_width;
  spec.image_height = task.image_height;
  spec.tick_seconds = task.tick_seconds;
  spec.action_time_limit = task.action_time_limit;
  spec.repeats_allowed = task.repeats_allowed != 0;
  for (const cause_t& cause : task.causes) spec.causes.push_back({cause.name, cause.words});
  return spec;
}

}  // namespace prospect::services
