#pragma once

#include "cli/commands/replay.h"

namespace prospect::services {

// Each returns the exit code. @throws ExitError

int RunPlay(const cli::ReplayOptions& options);
int RunRebuildBus(const cli::RebuildBusOptions& options);
/// kExitTolerance where the worker chose otherwise.
int RunRebuildJournal(const cli::RebuildJournalOptions& options);

}  // namespace prospect::services
