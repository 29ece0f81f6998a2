#pragma once

#include <functional>
#include <initializer_list>

#include "services/common/bus.h"
#include "services/common/clock.h"

namespace prospect::services {

/// Polls all buses until `done` holds. @return whether it did within `deadline_ms`
inline bool PollUntil(std::initializer_list<Bus*> buses, const std::function<bool()>& done,
                      std::int64_t deadline_ms = 5000) {
  const std::int64_t end_ms = SteadyMs() + deadline_ms;
  while (!done()) {
    if (SteadyMs() >= end_ms) return false;
    for (Bus* bus : buses) bus->Poll(5);
  }
  return true;
}

}  // namespace prospect::services
