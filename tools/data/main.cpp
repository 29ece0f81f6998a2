// prospect-data: makes data sets and looks at them. Without libtorch.

#include "base/run_main.h"
#include "cli/program.h"
#include "tools/data/commands.h"
#ifdef PROSPECT_HAS_LOGS
#include "services/from_log/command.h"
#endif

int main(int argc, char** argv) {
  using namespace prospect;
  using cli::Carries;
  const std::vector<cli::Part> parts = {
      Carries("collect", "collect", tools::RunCollect),
      Carries("info", "dataset info", tools::RunInfo),
      Carries("pack", "dataset pack", tools::RunPack),
      Carries("merge", "merge", tools::RunMergeTrials),
      Carries("sheet", "dataset sheet", tools::RunSheet),
      Carries("task-check", "task check", tools::RunTaskCheck),
      Carries("export", "dataset export", tools::RunExport),
#ifdef PROSPECT_HAS_LOGS
      Carries("from-log", "dataset from-log", services::RunFromLog),
#endif
#ifdef PROSPECT_HAS_VIDEOS
      Carries("from-video", "dataset from-video", tools::RunFromVideo),
      Carries("from-robomimic", "dataset from-robomimic", tools::RunFromRobomimic),
#endif
  };
  return RunMain([&] { return cli::RunPart(argc, argv, parts); }, "prospect-data", kExitDisk);
}
