#pragma once

#include <cstdint>
#include <string>

#include "tests/integration/support/witness.h"

namespace prospect::tests {

/// A counter that a process tells on HEALTH; 0 when it tells none of this name.
std::int64_t Counter(const health_t& health, const std::string& name);

/// Rollouts made since their starts by all workers that live, as each tells itself.
std::int64_t RolloutsTold(const Witness& witness);

/// Waits until somebody listens at a TCP port. @return whether that was so within `timeout_ms`
bool PortOpens(const std::string& address, int port, int timeout_ms);

}  // namespace prospect::tests
