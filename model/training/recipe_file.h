#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "model/training/train_config.h"

namespace prospect::model {

/// One training run of a recipe: a whole configuration, begun from the weights of the run before.
struct RecipeRun {
  std::string name;                ///< of the folder, inside --out, that it works in
  std::string why;                 ///< what it adds, for those who read the file
  std::vector<std::string> fresh;  ///< stages whose networks begin from random weights all the same
  TrainConfig config;
};

/// How weights are made, from data to calibration: a file of recipes/ (docs/training.md). A plain
/// value.
struct RecipeFile {
  std::string task;
  std::vector<std::string> collect;  ///< commands that make the data set; train runs none of them
  std::string data_hash;             ///< of the data set that the bundled weights were made from
  std::vector<RecipeRun> runs;       ///< at least one; one after the other
  /// Commands for afterwards, calibration above all; {weights} stands for the weights file.
  std::vector<std::string> then;
};

/// Throws std::invalid_argument that names the file and what is wrong with it: no JSON, a key that
/// is unknown or there twice, a configuration out of range, a run without a name of its own.
RecipeFile ReadRecipe(const std::string& path);

}  // namespace prospect::model
