#pragma once

#include "cli/commands/tasks.h"
#include "cli/commands/upkeep.h"

namespace prospect::services {

/// Does whoever takes the simulator's place keep to the rules? Actions are really started. @return
/// the exit code: kExitTaskFailure where a rule is broken. @throws ExitError
int RunCheckRobot(const cli::CheckRobotOptions& options);

/// Writes a first task file from what a robot says of itself. Nothing moves. @return the exit code
/// @throws ExitError (kExitTimeout) where no TASK is heard, tasks::TaskFileError where what it says
/// cannot stand in a file
int RunTaskLearn(const cli::TaskLearnOptions& options);

}  // namespace prospect::services
