// For builds without OpenCV.

#include "base/exit_error.h"
#include "services/bench/plot.h"

namespace prospect::services {

void WritePlot(const std::string&, const nlohmann::json&, const std::string&) {
  throw ExitError(kExitUsage, "--plot: this build was made without OpenCV");
}

}  // namespace prospect::services
