#include "sim/task_factory.h"

#include <stdexcept>

#include "sim/navigation/navigation_task.h"

namespace prospect::sim {

std::vector<std::string> TaskNames() { return {"navigation"}; }

std::unique_ptr<Task> MakeTask(const std::string& name, const TaskOptions& options) {
  if (name == "navigation") return std::make_unique<NavigationTask>(options);
  std::string known;
  for (const std::string& task : TaskNames()) known += (known.empty() ? "" : ", ") + task;
  throw std::invalid_argument("unknown task '" + name + "': the tasks are " + known);
}

}  // namespace prospect::sim
