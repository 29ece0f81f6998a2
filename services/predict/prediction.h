#pragma once

#include "cli/commands/upkeep.h"
#include "report/futures_sheet.h"
#include "services/executive/conversation.h"

namespace prospect::services {

/// Looks at what the bus shows, asks a model server what comes next, and, if asked to, waits for
/// what really comes. Throws ExitError: kExitServiceLost, kExitWeights, kExitTimeout, kExitUsage on
/// actions that TASK does not have or allow.
report::FuturesSheet Predict(Conversation& talk, const cli::PredictOptions& options);

}  // namespace prospect::services
