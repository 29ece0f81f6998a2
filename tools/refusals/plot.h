#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace prospect::tools {

/// A PNG with a panel a task: risk against coverage, and under it what each split achieved. Throws
/// model::DiskError where it cannot be written, std::invalid_argument in a build that draws
/// nothing.
/// @param figures as MeasureRefusals makes them, at least one
void PlotRefusals(const std::string& path, const std::vector<nlohmann::json>& figures);

}  // namespace prospect::tools
