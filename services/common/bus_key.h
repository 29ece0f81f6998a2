#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace prospect::services {

/// The secret that the processes of one deployment share: who has it may command the robot. Held
/// in a file that only its owner may read, as 64 hexadecimal digits on one line.
struct BusKey {
  std::array<std::uint8_t, 32> bytes{};
};

/// Reads a key file.
/// @throws ExitError (kExitUsage) naming the file when it cannot be read, is not a key, or could
/// be read by other users (as ssh refuses such keys)
BusKey ReadBusKey(const std::string& path);

/// The key that a Bus of this process uses unless it is given one; null: an open bus, on which
/// whoever can send is believed. Set once, before the first Bus.
const BusKey* ProcessBusKey();
void SetProcessBusKey(const BusKey& key);

}  // namespace prospect::services
