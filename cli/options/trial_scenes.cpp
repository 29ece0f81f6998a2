#include "cli/options/trial_scenes.h"

#include "cli/values.h"

namespace prospect::cli {

void DefineTrialScenes(CLI::App& app, TrialSceneOptions& scenes) {
  app.add_option("--objects", scenes.objects,
                 "navigation: objects on the site; mixed: half of all trials have 4, the others 4 "
                 "to 7")
      ->type_name("N")
      ->check(OneOf({"4", "5", "6", "7", "mixed"}))
      ->capture_default_str();
  app.add_option("--legs", scenes.legs, "navigation: objects to investigate in a row")
      ->type_name("N")
      ->check(OneOf({"3", "4", "5", "mixed"}))
      ->capture_default_str();
  app.add_option("--tower", scenes.tower, "stacking: blocks in the tower")
      ->type_name("N")
      ->check(OneOf({"2", "3", "4", "mixed"}))
      ->capture_default_str();
  app.add_option("--scene-file", scenes.scene_file,
                 "stacking: a scene of one's own, like config/scenes/stacking.yaml")
      ->type_name("FILE");
}

}  // namespace prospect::cli
