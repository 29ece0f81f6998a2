#pragma once

#include <vector>

#include "planner/path_tree.h"

namespace prospect::services {

/// How many subtrees hang below each depth of a search's tree, kept up as the tree grows: says how
/// long a prefix must be so that the work divides well among servers. Time O(new paths). One
/// thread.
class SubtreeCounter {
 public:
  /// The shortest length, at least 1, at which there are `wanted` prefixes or more; the length with
  /// most of them while there are fewer.
  int PrefixLength(const planner::PathTree& paths, int wanted) {
    for (; next_ < paths.size(); ++next_) {
      const auto depth = static_cast<std::size_t>(paths.depth(next_));
      if (depth >= counts_.size()) counts_.resize(depth + 1, 0);
      ++counts_[depth];
    }
    std::size_t best = 1;
    for (std::size_t length = 1; length < counts_.size(); ++length) {
      if (counts_[length] >= wanted) return static_cast<int>(length);
      if (counts_[length] > counts_[best]) best = length;
    }
    return static_cast<int>(best);
  }

 private:
  std::vector<int> counts_;  // paths by length
  planner::PathId next_ = 0;
};

}  // namespace prospect::services
