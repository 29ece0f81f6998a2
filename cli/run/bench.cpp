// bench search: over a bus that is nobody else's, unless another is named.

#include <cstdlib>

#include "cli/run/bus_place.h"
#include "cli/run/carriers.h"
#include "cli/run/processes.h"

namespace prospect::cli {

Words ProgramsOf(const BenchSearchOptions&) {
  return {"prospect-bench", "prospect-model-server", "prospect-worker"};
}

int Run(const BenchSearchOptions& options, const Invocation& invocation) {
  Words command{PathOf("prospect-bench"), "search"};
  command.insert(command.end(), invocation.typed.begin(), invocation.typed.end());
  if (options.bus.empty()) {
    unsetenv("PROSPECT_DEPLOYMENT");
    command.insert(command.end(), {"--bus", EnterPrivateBus()});
  }
  return Become(command);
}

}  // namespace prospect::cli
