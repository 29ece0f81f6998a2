#include "sim/task_factory.h"

#include <stdexcept>

#include "sim/navigation/navigation_task.h"
#include "sim/stacking/stacking_task.h"
#include "sim/suturing/suturing_task.h"

namespace prospect::sim {

std::vector<std::string> TaskNames() { return {"navigation", "stacking", "suturing"}; }

void SetPlanLength(const std::string& name, int plan_length, TaskOptions* options) {
  if (name != "stacking") {
    options->legs = plan_length;
    return;
  }
  if (plan_length < 1 || plan_length % kStackingKinds != 0) {
    throw std::invalid_argument("stacking: a plan of " + std::to_string(plan_length) +
                                " actions builds no tower: give 9, 18 or 27");
  }
  options->tower = plan_length / kStackingKinds + 1;
}

void SetShift(const std::string& factor, int strength, TaskOptions* options) {
  const bool none = strength == 0;
  const double amount = ShiftAmount(factor, none ? 1 : strength);  // checks the name, too
  if (none) return;
  double& field = factor == "light"    ? options->shift.light
                  : factor == "camera" ? options->shift.camera
                  : factor == "colour" ? options->shift.hue
                                       : options->image_noise;
  field = amount;
}

std::unique_ptr<Task> MakeTask(const std::string& name, const TaskOptions& options) {
  if (name == "navigation") return std::make_unique<NavigationTask>(options);
  if (name == "stacking") return std::make_unique<StackingTask>(options);
  if (name == "suturing") return std::make_unique<SuturingTask>(options);
  std::string known;
  for (const std::string& task : TaskNames()) known += (known.empty() ? "" : ", ") + task;
  throw std::invalid_argument("unknown task '" + name + "': the tasks are " + known);
}

}  // namespace prospect::sim
