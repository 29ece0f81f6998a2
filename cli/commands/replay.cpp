#include "cli/commands/replay.h"

#include "cli/values.h"

namespace prospect::cli {

void Define(CLI::App& app, ReplayOptions& options) {
  app.add_option("FILE", options.log, "what lcm-logger wrote")->required();
  app.add_option("--speed", options.speed, "times as fast as it was recorded")
      ->type_name("X")
      ->check(Real(0.01, 1000))
      ->capture_default_str();
  app.add_flag("--with-commands", options.with_commands,
               "ACTION_COMMAND and SIM_COMMAND, too: a robot on that bus obeys them");
  DefineQuiet(app, options.quiet);
  DefineProcess(app, options.bus);
}

void Define(CLI::App& app, RebuildBusOptions& options) {
  app.add_option("FILE", options.log, "what lcm-logger wrote")->required();
  app.add_option("--tables", options.tables, "write each search's table into this folder")
      ->type_name("DIR");
  DefineReport(app, options.report);
}

void Define(CLI::App& app, RebuildJournalOptions& options) {
  app.add_option("FILE", options.journal, "what prospect-worker --journal wrote")->required();
  DefineReport(app, options.report);
}

}  // namespace prospect::cli
