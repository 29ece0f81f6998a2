#include "services/common/common_options.h"

#include <CLI/CLI.hpp>

#include "services/common/bus_key.h"
#include "services/common/chaos.h"
#include "services/common/health.h"
#include "services/common/ids.h"
#include "services/common/log.h"
#include "services/common/signals.h"

namespace prospect::services {

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
