#pragma once

#include <yaml-cpp/yaml.h>

#include <set>
#include <string>

namespace prospect::base {

/// The first key that a map of `node` names twice, with the names around it ("gripper.force"), of
/// which yaml-cpp would take one in silence; empty: there is none.
inline std::string KeyTwice(const YAML::Node& node, const std::string& path = "") {
  std::set<std::string> keys;
  if (node.IsMap()) {
    for (const auto& entry : node) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
      const std::string here = path.empty() ? key : path + "." + key;
      if (!keys.insert(key).second) return here;
      if (const std::string inner = KeyTwice(entry.second, here); !inner.empty()) return inner;
    }
  }
  if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string inner = KeyTwice(node[i], path + "[" + std::to_string(i) + "]");
      if (!inner.empty()) return inner;
    }
  }
  return "";
}

}  // namespace prospect::base
