#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace prospect::report {

/// A PNG with a panel a task: risk against coverage, and under it what each split achieved. Throws
/// base::DiskError where it cannot be written.
/// @param figures as tools/refusals measures them, at least one
void WriteRefusalPlot(const std::string& path, const std::vector<nlohmann::json>& figures);

}  // namespace prospect::report
