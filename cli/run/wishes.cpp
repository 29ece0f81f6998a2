#include "cli/run/wishes.h"

#include "base/exit_error.h"
#include "cli/options/task.h"

namespace prospect::cli {

Words WishesOf(const EpisodeOptions& episode, const std::string& weights) {
  Words wishes;
  const auto add = [&wishes](const char* name, const std::string& value) {
    if (!value.empty()) wishes.insert(wishes.end(), {name, value});
  };
  add("--task", episode.task.empty() ? "" : TaskOf(episode.task).spec.name);
  add("--weights", weights);
  if (episode.workers > 0) add("--workers", std::to_string(episode.workers));
  const SceneOptions& scene = episode.scene;
  if (scene.objects > 0 || scene.legs > 0 || scene.tower > 0) wishes.push_back("--scene");
  return wishes;
}

void RequireScene(const SceneOptions& scene, const std::string& task) {
  const std::string defect = SceneDefect(scene, task);
  if (!defect.empty()) throw ExitError(kExitUsage, defect);
}

}  // namespace prospect::cli
