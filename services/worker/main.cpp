// prospect-worker: a planner worker. Start as many as there are processors to spare; they find the
// search by themselves.

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>

#include "base/run_main.h"
#include "services/common/common_options.h"
#include "services/common/health_monitor.h"
#include "services/common/signals.h"
#include "services/worker/worker.h"

namespace {

using namespace prospect;
using namespace prospect::services;

// Everybody waits for the model server, so on a machine that they share workers let it go first:
// its batches then follow each other at once. Before any thread is made: each inherits it.
void YieldTo(int niceness) {
  errno = 0;
  if (nice(niceness) == -1 && errno != 0) spdlog::warn("cannot yield: {}", std::strerror(errno));
}

int Run(int argc, char** argv) {
  CLI::App app(
      "Planner worker: searches imagined futures together with all other workers on the bus");
  CommonOptions common;
  WorkerOptions options;
  cli::DefineProcess(app, common);
  AddInstanceFileOption(app, common);
  app.add_option("--index", options.index,
                 "breaks ties differently in each worker; -1: drawn at random")
      ->envname("PROSPECT_WORKER_INDEX")
      ->check(CLI::Range(-1, 65535))
      ->capture_default_str();
  app.add_option("--statistics-period", options.statistics_period_ms,
                 "ms between two SEARCH_STATISTICS messages")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--statistics-bytes", options.statistics_bytes,
                 "byte budget of one SEARCH_STATISTICS message")
      ->check(CLI::Range(256, 60000))
      ->capture_default_str();
  app.add_option("--journal", options.journal,
                 "write all that is heard and chosen to this file, for prospect rebuild journal");
  int niceness = 10;
  app.add_option("--nice", niceness,
                 "how far to yield the processor to the model server, as nice(1)")
      ->check(CLI::Range(0, 19))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  ApplyCommonOptions(common, "worker");

  YieldTo(niceness);
  Bus bus(common.bus);
  HealthMonitor monitor(bus);
  Worker worker(bus, options);
  monitor.RequireOwnBus();
  while (!StopRequested()) worker.Turn();
  worker.Leave();
  return kExitSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}
