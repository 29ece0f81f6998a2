#include <stdexcept>

#include "tools/refusals/plot.h"

namespace prospect::tools {

void PlotRefusals(const std::string&, const std::vector<nlohmann::json>&) {
  throw std::invalid_argument("--plot: this build draws nothing, since it did not find OpenCV");
}

}  // namespace prospect::tools
