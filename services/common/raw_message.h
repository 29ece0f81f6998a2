#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace prospect::services {

/// A message as it came, copied out of LCM.
struct RawMessage {
  std::string channel;
  std::int64_t received_utime;  ///< when this host received it, microseconds since the epoch
  std::vector<std::uint8_t> bytes;
  const char* refused = nullptr;  ///< why it is not to be believed, as MessageVerifier says it
};

}  // namespace prospect::services
