#pragma once

#include <string>

#include "cli/options/bus.h"

namespace prospect::services {

/// The options that every process on the bus has, and that of services.
struct CommonOptions : cli::BusOptions {
  CommonOptions() = default;
  explicit CommonOptions(const cli::BusOptions& given) : cli::BusOptions(given) {}

  std::string instance_file;  ///< --instance-file, PROSPECT_INSTANCE_FILE; empty: none is written
};

/// Adds --instance-file, for services: a health check finds by it this very process among others of
/// its kind, whose host name and pid may be the same where each has a container of its own.
void AddInstanceFileOption(CLI::App& app, CommonOptions& options);

/// Call after parsing: sets up the log, reads the key, takes over deployment id and chaos, installs
/// the stop signals. @throws ExitError as ReadBusKey does; std::invalid_argument: no such chaos
/// @param component the program's short name, for the log
void ApplyCommonOptions(const CommonOptions& options, const std::string& component);

}  // namespace prospect::services
