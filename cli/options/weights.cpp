#include "cli/options/weights.h"

#include <CLI/CLI.hpp>

#include <filesystem>

#include "cli/installation.h"
#include "cli/options/task.h"

namespace prospect::cli {

void DefineWeightsFile(CLI::App& app, std::string& weights) {
  app.add_option("--weights", weights, "weights file, or a folder of TASK.safetensors")
      ->default_str("the bundled ones")
      ->type_name("PATH");
}

std::string WeightsFile(const std::string& given, const std::string& task) {
  const std::string file = "/" + TaskOf(task).spec.name + ".safetensors";
  if (given.empty()) return DataFolder("model/weights") + file;
  std::error_code none;
  return std::filesystem::is_directory(given, none) ? given + file : given;
}

}  // namespace prospect::cli
