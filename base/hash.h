#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace prospect::base {

// For names of things, files and paths, not against an adversary. What is hashed is stored and sent
// (weights, tasks, data sets, search tables), so these functions never change.

constexpr std::uint64_t kHashStart = 0xcbf29ce484222325ULL;  ///< FNV's offset basis
constexpr std::uint64_t kHashPrime = 0x100000001b3ULL;       ///< FNV's prime

/// The 64-bit FNV-1a hash of `n` bytes (Fowler, Noll, Vo). `state` continues an earlier one.
inline std::uint64_t HashBytes(const void* data, std::size_t n, std::uint64_t state = kHashStart) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < n; ++i) state = (state ^ bytes[i]) * kHashPrime;
  return state;
}

inline std::uint64_t HashText(std::string_view text, std::uint64_t state = kHashStart) {
  return HashBytes(text.data(), text.size(), state);
}

/// 16 lower-case hexadecimal digits.
inline std::string HexText(std::uint64_t value) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (int i = 15; i >= 0; --i, value >>= 4) {
    text[static_cast<std::size_t>(i)] = kDigits[value & 15];
  }
  return text;
}

/// A step of SplitMix64 (Steele, Lea, Flood 2014): a bijection of 64-bit words that spreads every
/// bit over all others.
constexpr std::uint64_t Mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace prospect::base
