#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace prospect::report {

/// A PNG of rollouts/s against workers (both axes by doubling), with the line of growth in
/// proportion beside it, and each point's mean batch written at it.
/// @param rows with "workers" (ascending), "rollouts_per_s" and "mean_batch"; at least one. Throws
/// base::DiskError.
void WriteScalingPlot(const std::string& path, const nlohmann::json& rows,
                      const std::string& title);

}  // namespace prospect::report
