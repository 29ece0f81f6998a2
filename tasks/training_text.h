#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace prospect::tasks {

/// The section "training" of a file as a JSON object, for model/training's configuration, which
/// knows what may stand in it. Throws TaskFileError where it is no map of maps and scalars.
std::string TrainingText(const std::string& file, const YAML::Node& node);

}  // namespace prospect::tasks
