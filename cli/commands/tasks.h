#pragma once

#include <string>

#include "cli/fwd.h"
#include "cli/options/bus.h"
#include "cli/options/report.h"

namespace prospect::cli {

/// Lists the tasks that are installed.
struct TasksOptions {
  ReportOptions report;
};
void Define(CLI::App& app, TasksOptions& options);

/// Says what is wrong or missing in a task file.
struct TaskCheckOptions {
  std::string file;
  ReportOptions report;
};
void Define(CLI::App& app, TaskCheckOptions& options);

/// Writes a first task file from what a robot says on the bus.
struct TaskLearnOptions {
  BusOptions bus;
  std::string out;
  double seconds = 5;      ///< to wait for TASK
  bool overwrite = false;  ///< a file that is there
  ReportOptions report;
};
void Define(CLI::App& app, TaskLearnOptions& options);

}  // namespace prospect::cli
