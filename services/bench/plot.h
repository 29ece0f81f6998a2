#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace prospect::services {

/// A PNG of rollouts/s against workers (both axes by doubling), with the line of growth in
/// proportion beside it, and each point's mean batch and share of best decisions written at it.
/// @param rows as RowOf makes them @throws base::DiskError
void WritePlot(const std::string& path, const nlohmann::json& rows, const std::string& title);

}  // namespace prospect::services
