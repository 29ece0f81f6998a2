#pragma once

#include <cstdint>
#include <string>

namespace prospect::services {

/// Where a recording is played unless another bus is named: next to the default bus, never on it.
inline constexpr char kReplayBusUrl[] = "udpm://239.255.76.67:7668?ttl=0&recv_buf_size=4194304";

struct PlayOptions {
  std::string log;                  ///< what lcm-logger wrote
  std::string bus = kReplayBusUrl;  ///< LCM URL
  double speed = 1;                 ///< times as fast as it was recorded, above 0
  bool with_commands = false;       ///< ACTION_COMMAND and SIM_COMMAND, too
};

struct PlayResult {
  std::int64_t played = 0;
  std::int64_t commands_left_out = 0;
  std::int64_t damaged = 0;  ///< stretches of the file that were no event
  bool interrupted = false;
};

/// Plays a recording onto a bus for people and programs that look: with the pauses it was recorded
/// with, without tags of a key, and without commands, so that it moves nothing. Returns at its end
/// or when a stop signal comes.
/// @throws ExitError: kExitBusInUse when anybody else speaks on the bus, before or while it plays;
/// kExitDataFile when the file is no recording; BusError
PlayResult PlayLog(const PlayOptions& options);

}  // namespace prospect::services
