#pragma once

#include "cli/options/scene.h"
#include "sim/task_factory.h"

namespace prospect::tools {

/// The world that the options of a command line ask for.
inline sim::TaskOptions WorldOf(const cli::SceneOptions& scene) {
  sim::TaskOptions world;
  if (scene.objects > 0) world.objects = scene.objects;
  if (scene.legs > 0) world.legs = scene.legs;
  if (scene.tower > 0) world.tower = scene.tower;
  world.scene_file = scene.scene_file;
  return world;
}

}  // namespace prospect::tools
