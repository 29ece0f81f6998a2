// tasks: which tasks are installed, and what each has.

#include <unistd.h>

#include <cstdio>

#include "base/text.h"
#include "cli/options/task.h"
#include "cli/options/weights.h"
#include "cli/report_file.h"
#include "cli/run/carriers.h"

namespace prospect::cli {
namespace {

bool HasWeights(const std::string& name) {
  return access(WeightsFile("", name).c_str(), R_OK) == 0;
}

std::string LengthsOf(const tasks::TaskFile& task) {
  std::vector<std::string> lengths;
  for (const int length : task.plan_lengths) lengths.push_back(std::to_string(length));
  return base::Joined(lengths);
}

void PrintRow(const tasks::TaskFile& task) {
  const sim::TaskSpec& spec = task.spec;
  const std::string size =
      std::to_string(spec.image_width) + "x" + std::to_string(spec.image_height);
  std::printf("%-15s %7zu  %-9s %-8s %-9s %-7s %s\n", spec.name.c_str(), spec.actions.size(),
              task.only_predicted ? "-" : LengthsOf(task).c_str(), size.c_str(),
              task.simulator ? "yes" : "-", HasWeights(spec.name) ? "yes" : "-",
              task.usual ? "the default" : "");
}

nlohmann::json RowOf(const tasks::TaskFile& task) {
  return {{"name", task.spec.name},
          {"file", task.path},
          {"actions", task.spec.actions.size()},
          {"plan_length", task.plan_lengths},
          {"width", task.spec.image_width},
          {"height", task.spec.image_height},
          {"only_predicted", task.only_predicted},
          {"simulator", task.simulator.has_value()},
          {"weights", HasWeights(task.spec.name)},
          {"default", task.usual}};
}

}  // namespace

int Run(const TasksOptions& options) {
  nlohmann::json rows = nlohmann::json::array();
  if (options.report.talks())
    std::printf("%-15s %7s  %-9s %-8s %-9s %-7s\n", "task", "actions", "plans of", "picture",
                "simulator", "weights");
  for (const std::string& name : TaskNames(Tasks::kAll)) {
    if (options.report.talks()) PrintRow(TaskOf(name));
    rows.push_back(RowOf(TaskOf(name)));
  }
  for (const auto& [name, wrong] : BadTasks())
    std::fprintf(stderr, "prospect: %s\n", wrong.c_str());
  WriteReport(options.report, {{"tasks", rows}});
  return kExitSuccess;
}

}  // namespace prospect::cli
