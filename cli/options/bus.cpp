#include "cli/options/bus.h"

#include <limits>

#include "cli/values.h"

namespace prospect::cli {
namespace {

constexpr char kBusGroup[] = "The bus";

}  // namespace

void DefineBusUrl(CLI::App& app, std::string& bus) {
  app.add_option("--bus", bus, "LCM URL (default $LCM_DEFAULT_URL, or loopback, port 7667)")
      ->type_name("URL")
      ->group(kBusGroup);
}

void DefineBus(CLI::App& app, BusOptions& options) {
  DefineBusUrl(app, options.bus);
  app.add_option("--key", options.key,
                 "the deployment's key: whoever does not have it is not believed; without one (and "
                 "without $PROSPECT_KEY_FILE) whoever can send is")
      ->type_name("FILE")
      ->envname("PROSPECT_KEY_FILE")
      ->group(kBusGroup);
  app.add_option("--chaos", options.chaos,
                 "for tests: faults in what a process hears, such as "
                 "drop=0.3,delay=20ms,dup=0.05,reorder=0.1,corrupt=0.01,seed=1; also "
                 "channel=SEARCH_.*; several parted by ';'")
      ->type_name("FAULTS")
      ->envname("PROSPECT_CHAOS")
      ->group(kBusGroup);
}

void DefineProcess(CLI::App& app, BusOptions& options) {
  DefineBus(app, options);
  app.add_option("--log-level", options.log_level, "what is logged")
      ->type_name("LEVEL")
      ->envname("PROSPECT_LOG_LEVEL")
      ->check(OneOf({"trace", "debug", "info", "warn", "error", "off"}))
      ->capture_default_str()
      ->group(kBusGroup);
  app.add_option("--deployment", options.deployment,
                 "id that all processes of one launch share; 0: whatever is on the bus")
      ->type_name("N")
      ->envname("PROSPECT_DEPLOYMENT")
      ->transform(Whole(0, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str()
      ->group(kBusGroup);
}

}  // namespace prospect::cli
