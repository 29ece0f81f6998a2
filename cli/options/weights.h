#pragma once

#include <string>

#include "cli/fwd.h"

namespace prospect::cli {

/// Adds --weights: a weights file or a folder of such. Empty: the bundled ones of the task.
void DefineWeightsFile(CLI::App& app, std::string& weights);

/// The file that was meant: `given` itself, TASK.safetensors in it if it is a folder, or the
/// bundled weights of the task if it is empty. @param task NAME|FILE, as of --task
std::string WeightsFile(const std::string& given, const std::string& task);

}  // namespace prospect::cli
