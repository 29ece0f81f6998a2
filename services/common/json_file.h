#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace prospect::services {

/// Writes `value` to `path` (option --json), indented. Writes to another name first and renames, so
/// that a reader never sees half a file. @throws ExitError (kExitDisk) when the file cannot be
/// written
void WriteJsonFile(const std::string& path, const nlohmann::json& value);

}  // namespace prospect::services
