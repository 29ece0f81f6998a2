#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace prospect::sim {

// The 64-bit FNV-1a hash of `n` bytes (Fowler, Noll, Vo): for names of things, not for security.
// `hash` continues an earlier call.
inline std::uint64_t Fnv1a(const void* data, std::size_t n,
                           std::uint64_t hash = 0xcbf29ce484222325ULL) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < n; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3ULL;
  return hash;
}

inline std::uint64_t Fnv1a(const std::string& text) { return Fnv1a(text.data(), text.size()); }

}  // namespace prospect::sim
