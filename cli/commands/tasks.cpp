#include "cli/commands/tasks.h"

#include "cli/options/common.h"
#include "cli/values.h"

namespace prospect::cli {

void Define(CLI::App& app, TasksOptions& options) { DefineReport(app, options.report); }

void Define(CLI::App& app, TaskCheckOptions& options) {
  app.add_option("FILE", options.file, "a task file (docs/task-files.md)")->required();
  DefineReport(app, options.report);
}

void Define(CLI::App& app, TaskLearnOptions& options) {
  DefineOut(app, options.out, "the task file to write, such as tasks/rover.yaml", "FILE")
      ->required();
  app.add_option("--seconds", options.seconds, "how long to wait for the robot")
      ->type_name("S")
      ->check(Real(0.1, 60))
      ->capture_default_str();
  app.add_flag("--overwrite", options.overwrite, "a file that is there");
  DefineReport(app, options.report);
  DefineProcess(app, options.bus);
}

}  // namespace prospect::cli
