#pragma once

#include <string>

#include "cli/fwd.h"

namespace prospect::cli {

/// Which scenes trials of a data set have: a number, or "mixed", drawn anew for each trial.
struct TrialSceneOptions {
  std::string objects = "4";  ///< navigation: objects on the site, 4 to 7, or mixed
  std::string legs = "3";     ///< navigation: objects to investigate in a row, 3 to 5, or mixed
  std::string tower = "2";    ///< stacking: blocks in the tower, 2 to 4, or mixed
  std::string scene_file;     ///< stacking: a scene of one's own; empty: the built-in one
};

/// Adds --objects, --legs, --tower and --scene-file.
void DefineTrialScenes(CLI::App& app, TrialSceneOptions& scenes);

}  // namespace prospect::cli
