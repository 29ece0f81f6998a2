#include "cli/options/scene.h"

#include "cli/values.h"

namespace prospect::cli {

void DefineSceneSize(CLI::App& app, SceneOptions& scene) {
  app.add_option("--objects", scene.objects, "navigation: objects on the site")
      ->type_name("N")
      ->transform(Whole(4, 7))
      ->default_str("4");
  app.add_option("--legs", scene.legs, "navigation: objects to investigate in a row")
      ->type_name("N")
      ->transform(Whole(3, 5))
      ->default_str("3");
  app.add_option("--tower", scene.tower, "stacking: blocks in the tower")
      ->type_name("N")
      ->transform(Whole(2, 4))
      ->default_str("2");
}

void DefineSceneFile(CLI::App& app, SceneOptions& scene) {
  app.add_option("--scene-file", scene.scene_file,
                 "stacking: a scene of one's own, like config/scenes/stacking.yaml")
      ->type_name("FILE");
}

void DefineScene(CLI::App& app, SceneOptions& scene) {
  DefineSceneSize(app, scene);
  DefineSceneFile(app, scene);
}

std::string SceneDefect(const SceneOptions& scene, const std::string& task) {
  const bool navigation = scene.objects > 0 || scene.legs > 0;
  if (task == "stacking" && navigation)
    return "--objects and --legs are navigation's; stacking takes --tower";
  if (task == "navigation" && scene.tower > 0)
    return "--tower is stacking's; navigation takes --objects and --legs";
  if (task != "stacking" && !scene.scene_file.empty()) return "--scene-file is stacking's";
  if (task != "stacking" && task != "navigation" && (navigation || scene.tower > 0))
    return "--objects, --legs and --tower are not for " + task;
  return "";
}

}  // namespace prospect::cli
