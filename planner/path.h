// A path names a node of the search: the actions taken from the root, in order. The transform is
// deterministic, so the same path is the same imagined future in every process; nothing else
// identifies a node on the bus. Plain values, free functions; safe from any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace prospect::planner {

// Actions from the root; the empty path is the root. At most kMaxPathLength long; each action <
// kMaxActions.
using Path = std::vector<std::uint8_t>;

constexpr int kMaxPathLength = 32;
constexpr int kMaxActions = 255;

// Spreads every input bit over all output bits (the finaliser of SplitMix64, Steele et al. 2014).
constexpr std::uint64_t Mix64(std::uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9ULL;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

// Folds `value` into `seed`; order matters.
constexpr std::uint64_t HashCombine(std::uint64_t seed, std::uint64_t value) {
  return Mix64(seed + 0x9e3779b97f4a7c15ULL + value);
}

// Hash of the root's path, and of a path made longer by one action: HashPath is these two, applied
// in turn.
constexpr std::uint64_t kRootHash = 0xcbf29ce484222325ULL;
constexpr std::uint64_t ExtendHash(std::uint64_t parent_hash, int action) {
  return HashCombine(parent_hash, static_cast<std::uint64_t>(action) + 1);
}

// The same number on every machine and in every version: it breaks ties, spreads work over servers,
// enters digests.
std::uint64_t HashPath(const Path& path);

// For unordered containers.
struct PathHash {
  std::size_t operator()(const Path& path) const { return HashPath(path); }
};

// "3-0-12"; the root prints as "root".
std::string ToString(const Path& path);

}  // namespace prospect::planner
