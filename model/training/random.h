#pragma once

#include <cstdint>

#include "base/random.h"

namespace prospect::model {

/// Random numbers as a pure function of (seed, stream, counter): batch `iteration` of a stage is
/// the same whether or not training was interrupted before it. Not thread-safe; make one where it
/// is needed.
class CounterRandom : public base::Random {
 public:
  CounterRandom(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter)
      : Random(base::Mix64(base::Mix64(seed) ^ stream) ^ counter) {}
  /// Uniform in 0..n-1, n > 0, of any size (the bias of 2^-64 n does not matter here).
  std::int64_t Below(std::int64_t n) {
    return static_cast<std::int64_t>(Next() % static_cast<std::uint64_t>(n));
  }
};

}  // namespace prospect::model
