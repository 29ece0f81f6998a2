#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace prospect::model {

/// Bijective mixing of 64 bits (the finaliser of splitmix64, Steele et al. 2014). Pure.
inline std::uint64_t Mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// FNV-1a over bytes, 64 bits, continued from `state`. For names and files, not against an
/// adversary.
inline std::uint64_t HashBytes(const void* data, std::size_t n,
                               std::uint64_t state = 0xcbf29ce484222325ULL) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < n; ++i) state = (state ^ bytes[i]) * 0x100000001b3ULL;
  return state;
}

inline std::uint64_t HashText(const std::string& text,
                              std::uint64_t state = 0xcbf29ce484222325ULL) {
  return HashBytes(text.data(), text.size(), state);
}

/// 16 lower-case hexadecimal digits.
inline std::string HexText(std::uint64_t value) {
  static const char* digits = "0123456789abcdef";
  std::string text(16, '0');
  for (int i = 15; i >= 0; --i, value >>= 4) text[static_cast<std::size_t>(i)] = digits[value & 15];
  return text;
}

}  // namespace prospect::model
