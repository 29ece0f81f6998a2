#pragma once

#include <map>
#include <string>

#include "cli/fwd.h"

namespace prospect::cli {

/// What tells one kind of scene from another. 0 or empty: left out; the world decides (4 objects, 3
/// legs, a tower of 2, config/scenes/stacking.yaml).
struct SceneOptions {
  int objects = 0;         ///< navigation: objects on the site
  int legs = 0;            ///< navigation: objects to investigate in a row
  int tower = 0;           ///< stacking: blocks in the tower
  std::string scene_file;  ///< stacking: a scene of one's own
};

/// Adds --objects, --legs and --tower.
void DefineSceneSize(CLI::App& app, SceneOptions& scene);

/// Adds --scene-file.
void DefineSceneFile(CLI::App& app, SceneOptions& scene);

/// Adds all four.
void DefineScene(CLI::App& app, SceneOptions& scene);

/// The options of a scene's size that were given, by name ("tower").
std::map<std::string, int> GivenSizes(const SceneOptions& scene);

/// Options that are not this task's (NAME|FILE); empty: none is. Throws tasks::TaskFileError.
std::string SceneDefect(const SceneOptions& scene, const std::string& task);

}  // namespace prospect::cli
