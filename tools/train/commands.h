#pragma once

#include <string>

#include "cli/commands/bench.h"
#include "cli/commands/tables.h"
#include "cli/commands/train.h"

namespace prospect::tools {

// What prospect-train carries out. Each returns the exit code; throws ExitError,
// std::invalid_argument, std::range_error, c10::Error.

/// @param command is kept in the weights: how they were made
int RunTrain(const cli::TrainOptions& options, const std::string& command);

/// The paper's two tables (tables of section V: successful examples only, and all of them), of any
/// set of trained variants, on the held-out trials of a data set.
int RunTables(const cli::TablesOptions& options);

int RunBenchTrain(const cli::BenchTrainOptions& options);
int RunBenchEngine(const cli::BenchEngineOptions& options);

}  // namespace prospect::tools
