#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/fwd.h"
#include "cli/options/task.h"

namespace prospect::cli {

/// Figures of what the networks keep, imagine and judge, on held-out trials.
struct FiguresOptions {
  std::string task = DefaultTask();
  std::string weights;            ///< file or its folder; empty: the bundled ones
  std::string data;               ///< of which only test trials are read; empty: the bundled trials
  std::string out;                ///< folder for the pictures and captions.md
  std::string variants;           ///< folder with NAME/TASK.safetensors; empty: none are shown
  std::uint64_t seed = 0;         ///< which trials and scenes are shown
  int trials = 200;               ///< for the calibration curves
  int samples = 30;               ///< rollouts of the search that is shown
  int examples = 6;               ///< rows of predictions.png
  std::vector<std::string> only;  ///< names as FigureNames(); empty: all that the weights can draw
  bool quiet = false;
};

void Define(CLI::App& app, FiguresOptions& options);

/// In the order in which they are drawn.
const std::vector<std::string>& FigureNames();

}  // namespace prospect::cli
