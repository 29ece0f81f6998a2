#pragma once

#include "cli/commands/console.h"

namespace prospect::services {

/// `prospect console`: serves the page until a stop signal comes. @throws ExitError when the bus,
/// the log, the page or the port cannot be had
int RunConsole(const cli::ConsoleOptions& options);

}  // namespace prospect::services
