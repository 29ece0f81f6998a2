#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/atomic_file.h"

namespace prospect::base {

/// Writes `value` to `path` (option --json), whole or not at all (WriteFile). `indent`: of each
/// level; -1: all in one line. Names of files and what others say are in whatever encoding they
/// are: what is not UTF-8 is replaced. Throws DiskError.
inline void WriteJsonFile(const std::string& path, const nlohmann::json& value, int indent = 2) {
  WriteFile(path, value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

}  // namespace prospect::base
