#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace prospect::tools {

// Draws what SummariseShifts gave to a PNG: stacked bars of solved, failed and refused by strength,
// a panel a factor. False in a build that draws nothing (without OpenCV). Throws model::DiskError.
bool WriteShiftPlot(const std::string& path, const nlohmann::json& summary,
                    const std::string& title);

}  // namespace prospect::tools
