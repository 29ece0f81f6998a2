#include "sim/tabletop/yaml_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace prospect::sim {

YamlReader::YamlReader(YAML::Node node, std::string path)
    : node_(std::move(node)), path_(std::move(path)) {
  if (!node_.IsMap())
    throw SceneFileError((path_.empty() ? "the scene file" : path_) +
                         ": must be a map of names to values");
}

bool YamlReader::Has(const std::string& key) const { return static_cast<bool>(node_[key]); }

void YamlReader::Fail(const std::string& key, const std::string& must) const {
  throw SceneFileError((path_.empty() ? key : path_ + "." + key) + ": " + must);
}

YamlReader YamlReader::At(const std::string& key) const {
  if (!Has(key)) Fail(key, "is missing");
  return YamlReader(node_[key], path_.empty() ? key : path_ + "." + key);
}

double YamlReader::Number(const std::string& key, double low, double high) const {
  double value = 0;
  if (!Has(key)) Fail(key, "is missing");
  try {
    value = node_[key].as<double>();
  } catch (const YAML::Exception&) {
    Fail(key, "must be a number");
  }
  if (!(value >= low && value <= high)) {
    Fail(key, "is " + std::to_string(value) + ", must be " + std::to_string(low) + " to " +
                  std::to_string(high));
  }
  return value;
}

int YamlReader::Integer(const std::string& key, int low, int high) const {
  const double value = Number(key, low, high);
  if (value != std::floor(value)) Fail(key, "must be a whole number");
  return static_cast<int>(value);
}

std::string YamlReader::Text(const std::string& key) const {
  if (!Has(key) || !node_[key].IsScalar()) Fail(key, "must be a text");
  return node_[key].Scalar();
}

std::vector<double> YamlReader::Numbers(const std::string& key, std::size_t n) const {
  std::vector<double> values;
  if (!Has(key)) Fail(key, "is missing");
  try {
    values = node_[key].as<std::vector<double>>();
  } catch (const YAML::Exception&) {
    values.clear();
  }
  const bool finite =
      std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  if (values.size() != n || !finite) Fail(key, "must be " + std::to_string(n) + " numbers");
  return values;
}

Eigen::Vector3d YamlReader::Vector(const std::string& key) const {
  return Eigen::Vector3d(Numbers(key, 3).data());
}

Eigen::Vector3d YamlReader::VectorOr(const std::string& key,
                                     const Eigen::Vector3d& fallback) const {
  return Has(key) ? Vector(key) : fallback;
}

void YamlReader::Only(std::initializer_list<const char*> known) const {
  for (const auto& entry : node_) {
    const std::string key = entry.first.as<std::string>();
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      Fail(key, "is not known here");
    }
  }
}

}  // namespace prospect::sim
