#include "cli/options/scene.h"

#include <vector>

#include "base/text.h"
#include "cli/options/task.h"
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

std::map<std::string, int> GivenSizes(const SceneOptions& scene) {
  std::map<std::string, int> given{
      {"objects", scene.objects}, {"legs", scene.legs}, {"tower", scene.tower}};
  std::erase_if(given, [](const auto& size) { return size.second <= 0; });
  return given;
}

std::string SceneDefect(const SceneOptions& scene, const std::string& task) {
  const tasks::TaskFile& file = TaskOf(task);
  const tasks::Simulator world = file.simulator.value_or(tasks::Simulator{});
  std::vector<std::string> own, foreign;
  for (const auto& [name, usual] : world.scene) own.push_back("--" + name);
  if (world.scene_file) own.push_back("--scene-file");
  for (const auto& [name, value] : GivenSizes(scene)) {
    if (!world.scene.count(name)) foreign.push_back("--" + name);
  }
  if (!scene.scene_file.empty() && !world.scene_file) foreign.push_back("--scene-file");
  if (foreign.empty()) return "";
  const std::string takes =
      own.empty() ? ", whose scenes have no such options" : ", which takes " + base::Joined(own);
  return base::Joined(foreign, " and ") + (foreign.size() == 1 ? " is" : " are") + " not for " +
         file.spec.name + takes;
}

}  // namespace prospect::cli
