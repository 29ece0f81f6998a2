#pragma once

#include <CLI/CLI.hpp>

#include "sim/task_factory.h"

namespace prospect::tools {

// What tells one kind of scene from another, the same for every program that makes scenes:
// --objects, --legs, --tower, --scene-file. What is out of range is refused by the option's name.
inline void AddSceneOptions(CLI::App* app, sim::TaskOptions* world) {
  app->add_option("--objects", world->objects, "Navigation: objects on the site, 4 to 7")
      ->check(CLI::Range(4, 7))
      ->capture_default_str();
  app->add_option("--legs", world->legs, "Navigation: objects to investigate in a row, 3 to 5")
      ->check(CLI::Range(3, 5))
      ->capture_default_str();
  app->add_option("--tower", world->tower, "Stacking: blocks in the tower, 2 to 4")
      ->check(CLI::Range(2, 4))
      ->capture_default_str();
  app->add_option("--scene-file", world->scene_file,
                  "Stacking: a file like config/scenes/stacking.yaml")
      ->check(CLI::ExistingFile);
}

}  // namespace prospect::tools
