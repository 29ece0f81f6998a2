#pragma once

#include "cli/commands/bench.h"

namespace prospect::services {

/// Evaluations a second of a model server's engine in a loop of its own, with nothing around it, in
/// batches of `mean_batch` on average: measured by another prospect-model-server, so that this
/// program needs no networks. @throws ExitError (kExitServiceLost)
double EngineAlone(const cli::BenchSearchOptions& options, double mean_batch);

}  // namespace prospect::services
