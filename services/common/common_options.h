#pragma once

#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace prospect::services {

/// The options that every process on the bus has. A program adds its own to the same CLI::App.
struct CommonOptions {
  std::string bus;                 ///< --bus URL; empty: LCM_DEFAULT_URL, then the default
  std::string key;                 ///< --key FILE, PROSPECT_KEY_FILE; empty: an open bus
  std::string log_level = "info";  ///< --log-level, PROSPECT_LOG_LEVEL
  std::string chaos;               ///< --chaos, PROSPECT_CHAOS: as ParseChaos takes it; empty: none
  std::int64_t deployment =
      0;  ///< --deployment, PROSPECT_DEPLOYMENT; 0: joins whatever is on the bus
  std::string instance_file;  ///< --instance-file, PROSPECT_INSTANCE_FILE; empty: none is written
};

/// Adds --bus, --key, --log-level, --chaos and --deployment. `options` must outlive the parsing.
void AddCommonOptions(CLI::App& app, CommonOptions& options);

/// Adds --instance-file, for services: a health check finds by it this very process among others of
/// its kind, whose host name and pid may be the same where each has a container of its own.
void AddInstanceFileOption(CLI::App& app, CommonOptions& options);

/// Call after parsing: sets up the log, reads the key, takes over deployment id and chaos, installs
/// the stop signals. @throws ExitError as ReadBusKey does
/// @param component the program's short name, for the log
void ApplyCommonOptions(const CommonOptions& options, const std::string& component);

}  // namespace prospect::services
