#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/fwd.h"
#include "cli/options/common.h"
#include "cli/options/report.h"
#include "cli/options/scene.h"
#include "cli/options/task.h"

namespace prospect::cli {

/// A picture of a task's scene, at any size and from any of its cameras, for people.
struct ViewOptions {
  std::string task = DefaultTask();
  std::uint64_t seed = kFirstReportedSeed;  ///< the scene
  SceneOptions scene;
  std::string episode;           ///< result.json, which decides task, seed and actions; empty: none
  std::vector<int> actions;      ///< carried out first
  std::string size = "640x480";  ///< WIDTHxHEIGHT, pixels
  std::string camera;            ///< of the scene's; empty: view, or the only one
  std::string out;               ///< PNG of the end
  std::string frames;            ///< folder for a PNG a tick
  std::string video;             ///< MP4 of every tick
  bool quiet = false;
};

void Define(CLI::App& app, ViewOptions& options);
std::string Defect(const ViewOptions& options);

}  // namespace prospect::cli
