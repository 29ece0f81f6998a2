#include <cstdio>
#include <filesystem>
#include <optional>

#include "base/atomic_file.h"
#include "base/exit_error.h"
#include "base/number_format.h"
#include "cli/installation.h"
#include "cli/report_file.h"
#include "services/binding/spec_messages.h"
#include "services/check_robot/command.h"
#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/common_options.h"
#include "services/common/signals.h"
#include "tasks/learned.h"

namespace prospect::services {
namespace {

task_t Heard(Bus& bus, double seconds) {
  std::optional<task_t> task;
  const auto subscription = bus.Subscribe<task_t>([&](const task_t& heard) { task = heard; });
  const std::int64_t end_ms = SteadyMs() + static_cast<std::int64_t>(1000 * seconds);
  while (!task && SteadyMs() < end_ms) {
    if (StopRequested()) throw ExitError(kExitInterrupted, "interrupted");
    bus.Poll(20);
  }
  if (task) return *task;
  throw ExitError(kExitTimeout, "no TASK was heard on " + bus.url() + " in " +
                                    base::Number("%g", seconds) +
                                    " s: is the robot there, with this deployment's key?");
}

}  // namespace

int RunTaskLearn(const cli::TaskLearnOptions& options) {
  if (!options.overwrite && std::filesystem::exists(options.out))
    throw ExitError(kExitUsage, options.out + " is there already: name another, or --overwrite");
  ApplyCommonOptions(CommonOptions(options.bus), "task-learn");
  Bus bus(options.bus.bus);
  const sim::TaskSpec spec = SpecFromTask(Heard(bus, options.seconds));
  base::WriteFile(options.out, tasks::LearnedFile(spec));
  if (options.report.talks())
    std::printf("%s: %s, %zu actions, plans of %d. Next: add goals; %s\n", options.out.c_str(),
                spec.name.c_str(), spec.actions.size(), spec.plan_length,
                cli::Typed("task check " + options.out).c_str());
  cli::WriteReport(options.report, {{"file", options.out},
                                    {"task", spec.name},
                                    {"actions", spec.actions.size()},
                                    {"plan_length", spec.plan_length}});
  return kExitSuccess;
}

}  // namespace prospect::services
