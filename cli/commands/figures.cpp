#include "cli/commands/figures.h"

#include "cli/options/common.h"
#include "cli/options/report.h"
#include "cli/options/weights.h"
#include "cli/values.h"

namespace prospect::cli {

const std::vector<std::string>& FigureNames() {
  static const std::vector<std::string> names = {
      "predictions", "reconstructions", "hidden-states", "random-states",
      "variants",    "futures",         "search",        "calibration"};
  return names;
}

void Define(CLI::App& app, FiguresOptions& options) {
  DefineTask(app, options.task, Tasks::kAll);
  DefineWeightsFile(app, options.weights);
  app.add_option("--data", options.data, "data set, of which only test trials are read")
      ->default_str("the bundled trials")
      ->type_name("FILE");
  DefineOut(app, options.out, "folder for the pictures and captions.md")->required();
  app.add_option("--variants", options.variants,
                 "folder of trained variants: NAME/TASK.safetensors each")
      ->type_name("DIR");
  DefineSeed(app, options.seed, "which trials and scenes are shown");
  app.add_option("--trials", options.trials, "test trials for the calibration curves")
      ->type_name("N")
      ->transform(Whole(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--samples", options.samples, "rollouts of the search that is shown")
      ->type_name("N")
      ->transform(Whole(1, 10'000))
      ->capture_default_str();
  app.add_option("--examples", options.examples, "rows of predictions.png")
      ->type_name("N")
      ->transform(Whole(1, 40))
      ->capture_default_str();
  app.add_option("--only", options.only, "only these figures")
      ->type_name("NAMES")
      ->delimiter(',')
      ->check(OneOf(FigureNames()));
  DefineQuiet(app, options.quiet);
}

}  // namespace prospect::cli
