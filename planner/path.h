// A path names a node of the search: the actions taken from the root, in order. The transform is
// deterministic, so the same path is the same imagined future in every process; nothing else
// identifies a node on the bus. Plain values, free functions; safe from any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/hash.h"

namespace prospect::planner {

// Actions from the root; the empty path is the root. At most kMaxPathLength long; each action <
// kMaxActions.
using Path = std::vector<std::uint8_t>;

constexpr int kMaxPathLength = 64;
constexpr int kMaxActions = 255;

// Folds `value` into `seed`; order matters.
constexpr std::uint64_t HashCombine(std::uint64_t seed, std::uint64_t value) {
  return base::Mix64(seed + value);
}

// Hash of the root's path, and of a path made longer by one action: HashPath is these two, applied
// in turn.
constexpr std::uint64_t kRootHash = base::kHashStart;
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
