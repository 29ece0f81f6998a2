#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// What every payload must survive, for whoever makes payloads: libFuzzer (libfuzzer.cpp) or our
/// own mutations (payload_test.cpp). Thread-safe.
namespace prospect::fuzz {

/// One message type.
struct Target {
  const char* type;  ///< such as "observation_t"
  /// Decodes the bytes as this type, as they are and once more without their seal (no mutation
  /// finds a seal that holds), and treats what is accepted as receivers do: validates it and turns
  /// it into what the planner works with. @return whether one of the two was accepted
  /// @throws std::logic_error when an accepted message encodes to other bytes
  bool (*feed)(const std::uint8_t* data, std::size_t size);
};

/// All types that travel alone, in alphabetical order.
const std::vector<Target>& Targets();

/// The target of this name, or null.
const Target* FindTarget(const std::string& type);

}  // namespace prospect::fuzz
