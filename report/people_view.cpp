#include "report/people_view.h"

#include <stdexcept>

#include "sim/stacking/stacking_task.h"

namespace prospect::report {

sim::Image PeoplesView(sim::Task& task, const std::string& camera, int width, int height) {
  auto* stacking = dynamic_cast<sim::StackingTask*>(&task);
  if (stacking != nullptr)
    return stacking->RenderFrom(camera.empty() ? "view" : camera, width, height);
  if (!camera.empty()) {
    throw std::invalid_argument("task '" + task.spec().name +
                                "' has one camera: leave --camera out");
  }
  return task.Render(width, height);
}

}  // namespace prospect::report
