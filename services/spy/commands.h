#pragma once

#include <string>

#include "cli/commands/upkeep.h"
#include "cli/fwd.h"
#include "cli/options/bus.h"
#include "cli/options/report.h"

namespace prospect::services {

// What prospect-bus does that is no command of its own: for scripts, containers and `prospect`.

/// Lists channels, types, rates and what could not be decoded.
struct CheckOptions {
  cli::BusOptions bus;
  double seconds = 5;
  cli::ReportOptions report;
};

/// Returns when services are there and ready.
struct WaitOptions {
  cli::BusOptions bus;
  std::string services;  ///< such as "simulator=1,model=1,worker=2"
  double seconds = 20;
};

/// Returns when anybody of a deployment is heard.
struct HeardOptions {
  cli::BusOptions bus;
  double seconds = 3;  ///< three signs of life
};

/// Is the service that wrote this instance file at work (for health checks).
struct HealthOptions {
  cli::BusOptions bus;
  std::string instance_file;
  double seconds = 3;
};

/// Does a message come back, and is the bus free.
struct ProbeOptions {
  cli::BusOptions bus;
};

void Define(CLI::App& app, CheckOptions& options);
void Define(CLI::App& app, WaitOptions& options);
void Define(CLI::App& app, HeardOptions& options);
void Define(CLI::App& app, HealthOptions& options);
void Define(CLI::App& app, ProbeOptions& options);

// Each returns the exit code. @throws ExitError

int RunCheck(const CheckOptions& options);
int RunWait(const WaitOptions& options);
int RunHeard(const HeardOptions& options);
int RunHealth(const HealthOptions& options);
int RunProbe(const ProbeOptions& options);
/// Every process: its state, age, queue, restarts.
int RunStatus(const cli::StatusOptions& options);

}  // namespace prospect::services
