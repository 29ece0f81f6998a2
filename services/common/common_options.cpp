#include "services/common/common_options.h"

#include <CLI/CLI.hpp>
#include <limits>

#include "services/common/bus_key.h"
#include "services/common/chaos.h"
#include "services/common/health.h"
#include "services/common/ids.h"
#include "services/common/log.h"
#include "services/common/signals.h"

namespace prospect::services {

void AddCommonOptions(CLI::App& app, CommonOptions& options) {
  app.add_option("--bus", options.bus,
                 "LCM URL; empty: LCM_DEFAULT_URL, then udpm://239.255.76.67:7667?ttl=0");
  app.add_option(
         "--key", options.key,
         "the deployment's key: messages of whoever does not have it are refused; empty: an "
         "open bus, where whoever can send is believed")
      ->envname("PROSPECT_KEY_FILE");
  app.add_option("--log-level", options.log_level, "trace, debug, info, warn, error, off")
      ->envname("PROSPECT_LOG_LEVEL")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}))
      ->capture_default_str();
  app.add_option("--chaos", options.chaos,
                 "for tests: faults in what this process hears, such as "
                 "drop=0.3,delay=20ms,dup=0.05,reorder=0.1,corrupt=0.01,seed=1,channel=SEARCH_.*; "
                 "several separated by ';'")
      ->envname("PROSPECT_CHAOS")
      ->check(ChaosDefect);
  app.add_option("--deployment", options.deployment,
                 "id that all processes of one launch share; 0 joins whatever is on the bus")
      ->envname("PROSPECT_DEPLOYMENT")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
}

void AddInstanceFileOption(CLI::App& app, CommonOptions& options) {
  app.add_option("--instance-file", options.instance_file,
                 "write the instance id of this process's HEALTH to this file, for prospect-bus "
                 "health")
      ->envname("PROSPECT_INSTANCE_FILE");
}

void ApplyCommonOptions(const CommonOptions& options, const std::string& component) {
  SetUpLog(component, options.log_level);
  if (!options.key.empty()) SetProcessBusKey(ReadBusKey(options.key));
  SetDeploymentId(options.deployment);
  SetChaos(options.chaos);
  SetInstanceFile(options.instance_file);
  InstallStopSignals();
}

}  // namespace prospect::services
