#include "cli/commands/oracle.h"

#include "cli/values.h"

namespace prospect::cli {

void Define(CLI::App& app, OracleOptions& options) {
  DefineTask(app, options.task, Tasks::kPlanned);
  app.add_option("--scenes", options.scenes, "number of scenes")
      ->type_name("N")
      ->transform(Whole(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of the first scene; scene i has seed + i")
      ->type_name("N")
      ->transform(Whole(0, kLargestSeed))
      ->capture_default_str();
  DefineScene(app, options.scene);
  app.add_option("--jobs", options.jobs, "processes")
      ->type_name("N")
      ->transform(Whole(1, 256))
      ->capture_default_str();
  app.add_option("--cache", options.cache, "folder of cached results")
      ->default_str("$PROSPECT_DATA/oracle or ~/.cache/prospect/oracle")
      ->type_name("DIR");
  app.add_flag("--fresh", options.fresh, "consult anew and write no cache");
  DefineShard(app, options.shard);
  DefineReport(app, options.report);
}

std::string Defect(const OracleOptions& options) {
  const std::string shard = ShardDefect(options.shard, options.report);
  return shard.empty() ? SceneDefect(options.scene, options.task) : shard;
}

}  // namespace prospect::cli
