#include "cli/commands/takes.h"

#include "cli/values.h"

namespace prospect::cli {

void Define(CLI::App& app, TakesOptions& options) {
  app.description(
      "Takes: from the same state the same actions twice, with fresh noise; how far the pictures "
      "differ in the end (mean absolute error, without sensor noise). Takes in which an action "
      "fails are left out");
  DefineTask(app, options.task, Tasks::kSimulated);
  DefineSeed(app, options.seed, "first scene");
  DefineScenes(app, options.scenes, "scenes, a random trial each", 1, 100'000);
  DefineScene(app, options.scene);
  app.add_option("--actions", options.most_actions, "of a trial at most so many")
      ->type_name("N")
      ->transform(Whole(2, 1000))
      ->capture_default_str();
  DefineReport(app, options.report);
}

std::string Defect(const TakesOptions& options) { return SceneDefect(options.scene, options.task); }

}  // namespace prospect::cli
