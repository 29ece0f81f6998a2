#include "services/common/common_options.h"

#include <CLI/CLI.hpp>
#include <limits>

#include "services/common/ids.h"
#include "services/common/log.h"
#include "services/common/signals.h"

namespace prospect::services {

void AddCommonOptions(CLI::App& app, CommonOptions& options) {
  app.add_option("--bus", options.bus,
                 "LCM URL; empty: LCM_DEFAULT_URL, then udpm://239.255.76.67:7667?ttl=0");
  app.add_option("--log-level", options.log_level, "trace, debug, info, warn, error, off")
      ->envname("PROSPECT_LOG_LEVEL")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}))
      ->capture_default_str();
  app.add_option("--deployment", options.deployment,
                 "id that all processes of one launch share; 0 joins whatever is on the bus")
      ->envname("PROSPECT_DEPLOYMENT")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
}

void ApplyCommonOptions(const CommonOptions& options, const std::string& component) {
  SetUpLog(component, options.log_level);
  SetDeploymentId(options.deployment);
  InstallStopSignals();
}

}  // namespace prospect::services
