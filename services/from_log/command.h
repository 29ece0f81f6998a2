#pragma once

#include "cli/commands/dataset.h"

namespace prospect::services {

/// Turns logs of the bus into a data set that trains the same networks as collected ones. @return
/// the exit code. @throws ExitError; kExitDataFile where the logs hold no whole trial
int RunFromLog(const cli::DatasetFromLogOptions& options);

}  // namespace prospect::services
