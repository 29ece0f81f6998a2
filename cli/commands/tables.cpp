#include "cli/commands/tables.h"

#include "cli/options/common.h"
#include "cli/values.h"

namespace prospect::cli {

void Define(CLI::App& app, TablesOptions& options) {
  DefineTask(app, options.task, Tasks::kAll);
  app.add_option("--data", options.data, "data set made by collect (HDF5)")
      ->type_name("FILE")
      ->required();
  app.add_option("--models", options.models,
                 "folder that train --variant wrote: VARIANT/TASK.safetensors a row")
      ->type_name("DIR");
  app.add_option("--weights", options.weights, "a weights file as one more row")->type_name("FILE");
  app.add_option("--judge", options.judge,
                 "classifiers file whose second classifier reads the labels of all rows")
      ->default_str("the first row's")
      ->type_name("FILE");
  DefineOut(app, options.out, "folder for tables.md and tables.csv")->required();
  app.add_option("--every", options.every, "take every so-many-th frame (1: all of them)")
      ->type_name("N")
      ->transform(Whole(1, 1000))
      ->capture_default_str();
  app.add_option("--trials", options.trials, "at most so many test trials (0: all)")
      ->type_name("N")
      ->transform(Whole(0, 1'000'000))
      ->capture_default_str();
  app.add_flag("--paper-tail", options.paper_tail,
               "keep frames of a trial's last action, which have no second one: the first again, "
               "as in the authors' code");
  DefineThreads(app, options.threads);
  DefineQuiet(app, options.quiet);
}

}  // namespace prospect::cli
