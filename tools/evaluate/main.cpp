// prospect-evaluate: what networks and planner do on scenes that nothing was trained or tuned on,
// and what is measured there and stored in the weights. Needs no bus.

#include "base/run_main.h"
#include "cli/program.h"
#include "tools/common/merge.h"
#include "tools/evaluate/commands.h"

int main(int argc, char** argv) {
  using namespace prospect;
  using cli::Carries;
  const std::vector<cli::Part> parts = {
      Carries("run", "evaluate", tools::RunEvaluate),
      Carries("plans", "evaluate plans", tools::RunPlans),
      Carries("shifts", "evaluate shifts", tools::RunShifts),
      Carries("calibrate", "evaluate calibrate", tools::RunCalibrate),
      Carries("novelty", "evaluate novelty", tools::RunNovelty),
      Carries("data", "evaluate data", tools::RunData),
#ifdef PROSPECT_HAS_BUS
      Carries("on-bus", "evaluate on-bus", tools::RunOnBus),
#endif
      Carries("refusals", "evaluate refusals", tools::RunRefusals),
      tools::CarriesMerge({tools::Merges("evaluate", tools::RunEvaluate),
                           tools::Merges("evaluate plans", tools::RunPlans),
                           tools::Merges("evaluate calibrate", tools::RunCalibrate)}),
  };
  return RunMain([&] { return cli::RunPart(argc, argv, parts); }, "prospect-evaluate", kExitDisk);
}
