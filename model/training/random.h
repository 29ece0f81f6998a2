#pragma once

#include <cstdint>

#include "model/hash.h"

namespace prospect::model {

/// Random numbers as a pure function of (seed, stream, counter): batch `iteration` of a stage is
/// the same whether or not training was interrupted before it. Not thread-safe; make one where it
/// is needed.
class CounterRandom {
 public:
  CounterRandom(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter)
      : state_(Mix64(Mix64(Mix64(seed) ^ stream) ^ counter)) {}
  std::uint64_t Next() { return Mix64(state_++); }
  /// Uniform in 0..n-1, n > 0 (the bias of 2^-64 n does not matter here).
  std::int64_t Below(std::int64_t n) {
    return static_cast<std::int64_t>(Next() % static_cast<std::uint64_t>(n));
  }
  double Uniform() { return static_cast<double>(Next() >> 11) * 0x1.0p-53; }  ///< in [0,1)

 private:
  std::uint64_t state_;
};

}  // namespace prospect::model
