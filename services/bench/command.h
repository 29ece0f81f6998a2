#pragma once

#include "cli/commands/bench.h"

namespace prospect::services {

/// What more planner workers give, measured over a bus with the real programs. @return the exit
/// code. @throws ExitError
int RunBenchSearch(const cli::BenchSearchOptions& options);

}  // namespace prospect::services
