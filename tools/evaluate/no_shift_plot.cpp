// In a build without OpenCV.

#include "tools/evaluate/shift_plot.h"

namespace prospect::tools {

bool WriteShiftPlot(const std::string&, const nlohmann::json&, const std::string&) { return false; }

}  // namespace prospect::tools
