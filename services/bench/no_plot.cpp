// For builds without OpenCV.

#include "services/bench/plot.h"
#include "services/common/exit_codes.h"
#include "services/common/run_main.h"

namespace prospect::services {

void WritePlot(const std::string&, const nlohmann::json&, const std::string&) {
  throw ExitError(kExitUsage, "--plot: this build was made without OpenCV");
}

}  // namespace prospect::services
