#include "cli/commands/verify.h"

#include "cli/values.h"

namespace prospect::cli {

void Define(CLI::App& app, VerifyOptions& options) {
  app.add_flag("--full", options.full, "everything, as in docs/results.md: hours");
  app.add_option("--jobs", options.jobs, "processes that share the work")
      ->default_str("all cores")
      ->type_name("N")
      ->transform(Whole(1, 256));
  app.add_option("--figures", options.figures,
                 "what to measure, and what docs/results.md says of it")
      ->default_str("config/figures.yaml")
      ->type_name("FILE");
  app.add_option("--weights", options.weights, "folder of weights, TASK.safetensors each")
      ->default_str("the bundled ones")
      ->type_name("DIR");
  app.add_option("--held-out", options.held_out, "folder of held-out trials, TASK.h5 each")
      ->default_str("the bundled ones")
      ->type_name("DIR");
  app.add_option("--work", options.work, "folder for trials and reports")
      ->default_str("$PROSPECT_DATA/verify or ~/.cache/prospect/verify")
      ->type_name("DIR");
  DefineReport(app, options.report);
}

}  // namespace prospect::cli
