#include "cli/commands/executive.h"

#include <CLI/CLI.hpp>

namespace prospect::cli {

void Define(CLI::App& app, ExecutiveOptions& options) {
  DefineEpisode(app, options.episode);
  DefineActing(app, options.acting);
  DefineTrialLoop(app, options.trials);
  DefineNoReset(app, options.reset);
  DefineAsk(app, options.ask);
  app.add_option("--world", options.world,
                 "the world_version that TASK must have, as prospect-simulator --check says it")
      ->type_name("HASH");
  app.add_flag("--explain-only", options.explain_only,
               "search once, tell why, and carry nothing out");
  DefineWhatIf(app, options.what_if);
  app.get_option("--what-if")->needs("--explain-only");
  DefineProcess(app, options.episode.bus);
}

std::string Defect(const ExecutiveOptions& options) {
  if (options.explain_only && options.acting.policy != "search")
    return "--explain-only needs --policy search";
  if (options.trials.episodes > 0 && options.episode.out.empty())
    return "--episodes counts trials in a folder: give --out";
  return TrialLoopDefect(options.trials, options.acting);
}

}  // namespace prospect::cli
