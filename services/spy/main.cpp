// prospect-bus: looks at the bus from a terminal, plays recordings, searches them again, tries a
// robot.

#include "base/run_main.h"
#include "cli/program.h"
#include "services/check_robot/command.h"
#include "services/replay/commands.h"
#include "services/spy/commands.h"

int main(int argc, char** argv) {
  using namespace prospect;
  using cli::Carries;
  const std::vector<cli::Part> parts = {
      Carries("status", "status", services::RunStatus),
      Carries("check", "prospect-bus check", services::RunCheck),
      Carries("wait", "prospect-bus wait", services::RunWait),
      Carries("heard", "prospect-bus heard", services::RunHeard),
      Carries("health", "prospect-bus health", services::RunHealth),
      Carries("probe", "prospect-bus probe", services::RunProbe),
      Carries("play", "replay", services::RunPlay),
      Carries("rebuild-bus", "rebuild bus", services::RunRebuildBus),
      Carries("rebuild-journal", "rebuild journal", services::RunRebuildJournal),
      Carries("task-learn", "task learn", services::RunTaskLearn),
      Carries("check-robot", "check-robot", services::RunCheckRobot),
  };
  return RunMain([&] { return cli::RunPart(argc, argv, parts); });
}
