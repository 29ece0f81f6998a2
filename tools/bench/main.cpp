// prospect-bench: how fast parts are, and what more of them give. Without libtorch.

#include "base/run_main.h"
#include "cli/program.h"
#include "tools/bench/commands.h"
#ifdef PROSPECT_HAS_BUS
#include "services/bench/command.h"
#endif

int main(int argc, char** argv) {
  using namespace prospect;
  using cli::Carries;
  const std::vector<cli::Part> parts = {
#ifdef PROSPECT_HAS_BUS
      Carries("search", "bench search", services::RunBenchSearch),
#endif
      Carries("simulated", "bench simulated", tools::RunBenchSimulated),
      Carries("overhead", "bench overhead", tools::RunBenchOverhead),
      Carries("sim", "bench sim", tools::RunBenchSim),
      Carries("picks", "bench picks", tools::RunBenchPicks),
  };
  return RunMain([&] { return cli::RunPart(argc, argv, parts); }, "prospect-bench", kExitDisk);
}
