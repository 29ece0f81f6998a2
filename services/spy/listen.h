#pragma once

#include <algorithm>
#include <cstdint>

#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/signals.h"

namespace prospect::services {

/// Listens until the time is over or a signal comes. @return the seconds listened
inline double Listen(Bus& bus, double seconds) {
  const std::int64_t start_ms = SteadyMs();
  const auto length_ms = static_cast<std::int64_t>(1000 * seconds);
  std::int64_t passed_ms = 0;
  while (passed_ms < length_ms && !StopRequested()) {
    bus.Poll(static_cast<int>(length_ms - passed_ms));
    passed_ms = SteadyMs() - start_ms;
  }
  return static_cast<double>(std::max<std::int64_t>(passed_ms, 1)) / 1000;
}

}  // namespace prospect::services
