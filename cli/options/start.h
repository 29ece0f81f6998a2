#pragma once

#include <string>

#include "cli/fwd.h"

namespace prospect::cli {

/// What is chosen when a deployment is started, and stays so.
struct StartOptions {
  std::string weights;  ///< file, its folder, or "scripted"; empty: the bundled ones
  std::string factor;   ///< how the camera's pictures differ from those of trials; empty: not
  int strength = 0;     ///< how far, 1 to 5
  bool open = false;    ///< no key
};

/// Adds --weights.
void DefineWeights(CLI::App& app, std::string& weights);

/// Adds --factor, --strength and --open.
void DefineStart(CLI::App& app, StartOptions& options);

/// What is wrong with these, for this task; empty: nothing.
std::string StartDefect(const StartOptions& options, const std::string& task);

}  // namespace prospect::cli
