#pragma once

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace prospect::tools {

/// Writes `value` to `path`, whole or not at all. Throws std::runtime_error that names the file.
inline void WriteJsonFile(const std::string& path, const nlohmann::json& value, int indent = 2) {
  const std::string part = path + ".part";
  std::ofstream file(part);
  file << value.dump(indent) << '\n';
  file.close();
  if (file && std::rename(part.c_str(), path.c_str()) == 0) return;
  std::remove(part.c_str());
  throw std::runtime_error(path + ": cannot be written: check the folder and the space left");
}

}  // namespace prospect::tools
