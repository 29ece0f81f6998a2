#include "tasks/training_text.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "tasks/section.h"

namespace prospect::tasks {
namespace {

constexpr int kDeepest = 3;  // training.network.num_actions

nlohmann::json Scalar(const YAML::Node& node) {
  bool flag = false;
  std::int64_t whole = 0;
  double number = 0;
  const bool quoted = node.Tag() == "!";
  if (!quoted && YAML::convert<bool>::decode(node, flag)) return flag;
  if (!quoted && YAML::convert<std::int64_t>::decode(node, whole)) return whole;
  if (!quoted && YAML::convert<double>::decode(node, number) && std::isfinite(number))
    return number;
  return node.Scalar();
}

nlohmann::json Map(const std::string& file, const YAML::Node& node, int depth) {
  nlohmann::json object = nlohmann::json::object();
  if (!node.IsMap() || depth == kDeepest)
    FailAt(file, node, "training must be a map of settings, as 'train --print-config' has them");
  for (const auto& entry : node) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (object.contains(key))
      FailAt(file, entry.first, Quoted(key) + " is there twice: leave one out");
    object[key] =
        entry.second.IsScalar() ? Scalar(entry.second) : Map(file, entry.second, depth + 1);
  }
  return object;
}

}  // namespace

std::string TrainingText(const std::string& file, const YAML::Node& node) {
  return Map(file, node, 0).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace prospect::tasks
