#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace prospect::report {

/// Draws what tools/evaluate's SummariseShifts gave to a PNG: stacked bars of solved, failed and
/// refused by strength, a panel a factor. Throws base::DiskError.
void WriteShiftPlot(const std::string& path, const nlohmann::json& summary,
                    const std::string& title);

}  // namespace prospect::report
