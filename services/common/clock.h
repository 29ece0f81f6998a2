#pragma once

#include <chrono>
#include <cstdint>

namespace prospect::services {

/// Wall clock for the `utime` field of messages: microseconds since the epoch. May jump; never use
/// it for time-outs.
inline std::int64_t UtimeNow() {
  using std::chrono::duration_cast;
  using std::chrono::microseconds;
  return duration_cast<microseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// Steady clock for time-outs, leases and periods: milliseconds since an arbitrary start, never
/// falling.
inline std::int64_t SteadyMs() {
  using std::chrono::duration_cast;
  using std::chrono::milliseconds;
  return duration_cast<milliseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The same clock in microseconds.
inline std::int64_t SteadyUs() {
  using std::chrono::duration_cast;
  using std::chrono::microseconds;
  return duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Says when something periodic is due. Time is passed in, so that tests need no real clock. Missed
/// periods are not made up for: after a stall the next one is a whole period away. Not thread-safe.
class Periodic {
 public:
  /// @param period_ms at least 1. The first call of Due() is true.
  explicit Periodic(std::int64_t period_ms) : period_ms_(period_ms) {}

  /// True when a period has passed since the last true answer (or on the first call, or after
  /// Hurry()).
  bool Due(std::int64_t now_ms) {
    if (started_ && now_ms - last_ms_ < period_ms_) return false;
    started_ = true;
    last_ms_ = now_ms;
    return true;
  }

  /// Makes the next Due() true: something changed and should not wait.
  void Hurry() { started_ = false; }

  /// Milliseconds until Due() turns true; 0 when it would now. For the time-out of Bus::Poll.
  std::int64_t Remaining(std::int64_t now_ms) const {
    if (!started_) return 0;
    const std::int64_t left = period_ms_ - (now_ms - last_ms_);
    return left > 0 ? left : 0;
  }

 private:
  std::int64_t period_ms_;
  std::int64_t last_ms_ = 0;
  bool started_ = false;
};

}  // namespace prospect::services
