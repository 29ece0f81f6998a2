#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/atomic_file.h"

namespace prospect::base {

/// Writes `value` to `path` (option --json), whole or not at all (WriteFile). `indent`: of each
/// level; -1: all in one line. Throws DiskError.
inline void WriteJsonFile(const std::string& path, const nlohmann::json& value, int indent = 2) {
  WriteFile(path, value.dump(indent) + '\n');
}

}  // namespace prospect::base
