#pragma once

#include "cli/commands/upkeep.h"

namespace prospect::services {

/// Does whoever takes the simulator's place keep to the rules? Actions are really started. @return
/// the exit code: kExitTaskFailure where a rule is broken. @throws ExitError
int RunCheckRobot(const cli::CheckRobotOptions& options);

}  // namespace prospect::services
