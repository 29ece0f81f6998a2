#pragma once

#include "cli/commands/bench.h"

namespace prospect::tools {

// What prospect-bench carries out without a bus. Each returns the exit code; throws ExitError,
// std::invalid_argument.

int RunBenchOverhead(const cli::BenchOverheadOptions& options);
int RunBenchSimulated(const cli::BenchSimulatedOptions& options);
int RunBenchSim(const cli::BenchSimOptions& options);
int RunBenchPicks(const cli::BenchPicksOptions& options);

}  // namespace prospect::tools
