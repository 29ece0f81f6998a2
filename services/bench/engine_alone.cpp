#include "services/bench/engine_alone.h"

#include <chrono>
#include <cstdlib>
#include <vector>

#include "base/child_process.h"
#include "base/exit_error.h"

namespace prospect::services {
namespace {

constexpr std::chrono::minutes kLongest{5};

}  // namespace

double EngineAlone(const cli::BenchSearchOptions& options, double mean_batch) {
  base::ChildOptions child;
  child.command = {base::ProgramBeside("prospect-model-server"),
                   "--weights",
                   options.weights,
                   "--threads",
                   std::to_string(options.threads),
                   "--time-batches",
                   std::to_string(mean_batch)};
  if (options.fixed_cost != "none")
    child.command.insert(child.command.end(), {"--fixed-cost", options.fixed_cost});
  const base::ChildResult result = base::RunCaptured(child, kLongest);
  const double rate = std::atof(result.out.c_str());
  if (result.status == 0 && rate > 0) return rate;
  throw ExitError(kExitServiceLost, "the engine alone was not measured: " + result.err);
}

}  // namespace prospect::services
