#include "cli/commands/ceiling.h"

#include "cli/options/common.h"
#include "cli/values.h"

namespace prospect::cli {

void Define(CLI::App& app, CeilingOptions& options) {
  app.description(
      "How well what V, f and T are asked can be known at all: test trials again from one of their "
      "moments on, with other execution noise and other actions. Of each figure two bounds: what "
      "half of the repetitions foretell of the others, and what all foretell of themselves. Task "
      "and scenes are to be those of the data set");
  DefineTask(app, options.task, Tasks::kSimulated);
  DefineTrialScenes(app, options.scenes);
  app.add_option("--trials", options.trials,
                 "test trials to look at; from those that last long enough one moment is taken")
      ->type_name("N")
      ->transform(Whole(1, 100'000))
      ->capture_default_str();
  app.add_option("--runs", options.runs, "repetitions from each moment, in each of three ways")
      ->type_name("N")
      ->transform(Whole(2, 1000))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of the first trial; only those of the test part count")
      ->type_name("N")
      ->transform(Whole(0, 999'999))
      ->capture_default_str();
  DefineJobs(app, options.jobs);
  DefineShard(app, options.shard);
  DefineReport(app, options.report);
}

std::string Defect(const CeilingOptions& options) {
  return ShardDefect(options.shard, options.report);
}

}  // namespace prospect::cli
