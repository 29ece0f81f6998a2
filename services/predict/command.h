#pragma once

#include "cli/commands/upkeep.h"

namespace prospect::services {

/// Asks the model server what the scene on the bus will look like next, and writes the pictures.
/// Nothing is planned and nothing is carried out. @return the exit code. @throws ExitError
int RunPredict(const cli::PredictOptions& options);

}  // namespace prospect::services
