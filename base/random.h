#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "base/hash.h"

namespace prospect::base {

// Random numbers that are the same wherever they are drawn: the standard library's distributions
// differ between implementations, and every stream here is named by what it is for, so that adding
// a draw in one place changes none elsewhere.

/// One seed from several numbers; their order matters.
inline std::uint64_t MixSeeds(std::initializer_list<std::uint64_t> values) {
  std::uint64_t hash = 0x243f6a8885a308d3ULL;
  for (std::uint64_t value : values) hash = Mix64(hash ^ value);
  return hash;
}

/// A stream of numbers: the hashes of a counter under a key. Not thread-safe; copy it to fork it.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(Mix64(seed)) {}

  std::uint64_t Next() { return Mix64(state_++); }

  /// In [0, 1).
  double Uniform() { return static_cast<double>(Next() >> 11) * 0x1.0p-53; }

  /// In [low, high).
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }

  /// In 0..n-1, n >= 1; the bias of the multiplication is below 2^-32 for the small n of scenes.
  int Below(int n) {
    return static_cast<int>(((Next() >> 32) * static_cast<std::uint64_t>(n)) >> 32);
  }

  /// Standard normal (Box and Muller); two draws a number keep the stream's position simple.
  double Normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
    return radius * std::cos(2.0 * 3.14159265358979323846 * Uniform());
  }

  /// Normal, cut off at two and a half deviations: execution noise without freak values.
  double BoundedNormal() {
    double value = Normal();
    while (std::abs(value) > 2.5) value = Normal();
    return value;
  }

 private:
  std::uint64_t state_;
};

}  // namespace prospect::base
