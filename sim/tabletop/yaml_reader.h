#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <stdexcept>
#include <string>

namespace prospect::sim {

// A scene file that cannot be used; the message names the entry and says what it must be.
class SceneFileError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

// A map of a scene file that knows where it stands, so that errors can say so: "gripper.force".
class YamlReader {
 public:
  YamlReader(YAML::Node node, std::string path);

  const std::string& path() const { return path_; }
  const YAML::Node& node() const { return node_; }
  bool Has(const std::string& key) const;

  // The entry `key`, which must be there.
  YamlReader At(const std::string& key) const;

  // A finite number in [low, high].
  double Number(const std::string& key, double low, double high) const;
  int Integer(const std::string& key, int low, int high) const;
  std::string Text(const std::string& key) const;

  // `n` finite numbers.
  std::vector<double> Numbers(const std::string& key, std::size_t n) const;
  Eigen::Vector3d Vector(const std::string& key) const;
  Eigen::Vector3d VectorOr(const std::string& key, const Eigen::Vector3d& fallback) const;

  // Refuses a map with an entry that none of `known` names: a misspelt one would be lost in
  // silence.
  void Only(std::initializer_list<const char*> known) const;

  [[noreturn]] void Fail(const std::string& key, const std::string& must) const;

 private:
  YAML::Node node_;
  std::string path_;
};

}  // namespace prospect::sim
