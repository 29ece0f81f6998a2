#pragma once

#include <chrono>

namespace prospect::base {

/// Seconds of the steady clock from `begin` until now.
inline double SecondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace prospect::base
