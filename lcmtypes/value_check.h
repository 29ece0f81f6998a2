#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "lcmtypes/messages.h"

/// The vocabulary in which validate*.cpp state what a sound message looks like. Internal to
/// lcmtypes/.
namespace prospect::messages::internal {

/// Collects the first thing that is wrong. Reasons are literals, so that counters by reason stay
/// few.
class ValueCheck {
 public:
  ValueCheck& That(bool ok, const char* reason) {
    if (!ok && !reason_) reason_ = reason;
    return *this;
  }
  bool ok() const { return !reason_; }
  std::string Result() const { return reason_ ? std::string("value ") + reason_ : ""; }

 private:
  const char* reason_ = nullptr;
};

template <class T>
bool InRange(T value, T low, T high) {
  return value >= low && value <= high;  // false for NaN
}

inline bool IsProbability(double value) { return InRange(value, 0.0, 1.0); }
inline bool IsCount(std::int64_t value) { return value >= 0; }
/// Milliseconds from now, or negative for none: at most ten years, so that microseconds and sums of
/// them stay in their type.
inline bool IsBudget(std::int64_t ms) { return ms <= 3650LL * 24 * 3600 * 1000; }
inline bool IsBoolean(std::int8_t value) { return value == 0 || value == 1; }
bool IsPath(const path_t& path);

/// Whether an RGB8 picture of this size has this many bytes, 1 to kMaxImageSide pixels a side.
bool IsPicture(std::int32_t width, std::int32_t height, std::int32_t num_bytes);

}  // namespace prospect::messages::internal
