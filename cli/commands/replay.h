#pragma once

#include <string>

#include "cli/fwd.h"
#include "cli/options/bus.h"
#include "cli/options/report.h"

namespace prospect::cli {

/// Plays a recording onto a bus of its own, without commands: nothing moves.
struct ReplayOptions {
  std::string log;             ///< what lcm-logger wrote
  double speed = 1;            ///< times as fast as it was recorded
  bool with_commands = false;  ///< ACTION_COMMAND and SIM_COMMAND, too
  bool quiet = false;
  BusOptions bus;  ///< without a URL: the bus of recordings (services/replay/log_player.h)
};

/// Rebuilds evaluations and rows of each search from a recording of the bus.
struct RebuildBusOptions {
  std::string log;     ///< what lcm-logger wrote
  std::string tables;  ///< folder for each search's table; empty: none
  ReportOptions report;
};

/// Repeats a worker's searches step by step.
struct RebuildJournalOptions {
  std::string journal;  ///< what prospect-worker --journal wrote
  ReportOptions report;
};

void Define(CLI::App& app, ReplayOptions& options);
void Define(CLI::App& app, RebuildBusOptions& options);
void Define(CLI::App& app, RebuildJournalOptions& options);

}  // namespace prospect::cli
