// prospect-console: the page on which people see a deployment think and act, live or from a log.

#include "base/run_main.h"
#include "cli/program.h"
#include "services/console/command.h"

int main(int argc, char** argv) {
  using namespace prospect;
  const std::vector<cli::Part> parts = {cli::Carries("", "console", services::RunConsole)};
  return RunMain([&] { return cli::RunPart(argc, argv, parts); });
}
