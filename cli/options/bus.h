#pragma once

#include <cstdint>
#include <string>

#include "cli/fwd.h"

namespace prospect::cli {

/// Loopback only (ttl 0), with a receive buffer that survives bursts: with the system's default 20
/// back-to-back pictures are already lost.
inline constexpr char kDefaultBusUrl[] = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304";

/// Which bus, and who is believed on it. Every process of a deployment has these.
struct BusOptions {
  std::string bus;                 ///< LCM URL; empty: LCM_DEFAULT_URL, then loopback, port 7667
  std::string key;                 ///< file; empty: PROSPECT_KEY_FILE, then an open bus
  std::string log_level = "info";  ///< of what a process logs
  std::string chaos;               ///< faults in what it hears, for tests; empty: none
  std::int64_t deployment = 0;     ///< shared by all of one launch; 0: whatever is on the bus
};

/// Adds --bus alone, for commands that only look up which deployment is there.
void DefineBusUrl(CLI::App& app, std::string& bus);

/// Adds --bus, --key and --chaos, for commands that start processes.
void DefineBus(CLI::App& app, BusOptions& options);

/// Adds --bus, --key, --chaos, --log-level and --deployment, for processes on the bus.
void DefineProcess(CLI::App& app, BusOptions& options);

}  // namespace prospect::cli
