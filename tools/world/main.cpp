// prospect-world: what the worlds allow, and what they look like. Without networks.

#include "base/run_main.h"
#include "cli/program.h"
#include "tools/common/merge.h"
#include "tools/world/commands.h"

int main(int argc, char** argv) {
  using namespace prospect;
  using cli::Carries;
  const std::vector<cli::Part> parts = {
      Carries("oracle", "oracle", tools::RunOracle),
      Carries("ceiling", "ceiling", tools::RunCeiling),
      Carries("takes", "takes", tools::RunTakes),
      Carries("view", "view", tools::RunView),
      tools::CarriesMerge(
          {tools::Merges("oracle", tools::RunOracle), tools::Merges("ceiling", tools::RunCeiling)}),
  };
  return RunMain([&] { return cli::RunPart(argc, argv, parts); }, "prospect-world", kExitDisk);
}
