#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

/// Conversions between 16-bit and 32-bit floats (IEEE 754). GCC's own type for the former is not in
/// every compiler that builds this. Pure.
namespace prospect::model {

inline float HalfToFloat(std::uint16_t half) {
  const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000) << 16;
  const std::uint32_t exponent = half >> 10 & 31, mantissa = half & 1023;
  if (exponent == 0) {  // zero, or a number below 2^-14 with fewer digits
    const float small = static_cast<float>(mantissa) * 0x1p-24F;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(small) | sign);
  }
  const std::uint32_t wide = exponent == 31 ? 255 : exponent + (127 - 15);
  return std::bit_cast<float>(sign | wide << 23 | mantissa << 13);
}

/// To the nearest, ties to even; what is too large becomes infinite.
inline std::uint16_t FloatToHalf(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000);
  const std::uint32_t size = bits & 0x7fffffff;
  const auto with_sign = [sign](std::uint32_t rest) {
    return static_cast<std::uint16_t>(sign | rest);
  };
  if (size > 0x7f800000) return with_sign(0x7e00);   // not a number
  if (size >= 0x477ff000) return with_sign(0x7c00);  // rounds to 65,536 or more
  if (size < 0x38800000) {                           // below 2^-14: adding 0.5 rounds to 2^-24
    const float shifted = std::bit_cast<float>(size) + 0.5F;
    return with_sign(std::bit_cast<std::uint32_t>(shifted) - 0x3f000000);
  }
  const std::uint32_t odd = size >> 13 & 1;
  return with_sign((size - ((127 - 15) << 23) + 0xfff + odd) >> 13);
}

}  // namespace prospect::model
