// Numbers the paths that a search has met, so that tables about paths can be plain vectors. Id 0 is
// the root; a parent's id is always below its children's. Ids are local to one PathTree and never
// leave the process. Not thread safe. Owns its memory; grows, never shrinks. Finding or adding a
// child is O(1) without hashing: a node with children holds one slot for each action.
#pragma once

#include <cstdint>
#include <vector>

#include "planner/path.h"

namespace prospect::planner {

using PathId = std::int32_t;
constexpr PathId kRoot = 0;
constexpr PathId kNoPath = -1;

class PathTree {
 public:
  // num_actions: 1 to kMaxActions; throws std::invalid_argument otherwise.
  explicit PathTree(int num_actions);

  // The child of `parent` by `action` (0 <= action < num_actions), or kNoPath if it was never
  // added.
  PathId Find(PathId parent, int action) const;
  // The id of `path`, or kNoPath. Any path is accepted.
  PathId Find(const Path& path) const;

  // As Find, but adds what is missing.
  PathId Add(PathId parent, int action);
  // Throws std::invalid_argument if the path is longer than kMaxPathLength or names an action
  // outside the table.
  PathId Add(const Path& path);
  // Whether Add(path) would succeed.
  bool Valid(const Path& path) const;

  // Facts of a known id; the root's parent is kNoPath and its action -1.
  PathId parent(PathId id) const { return nodes_[id].parent; }
  int action(PathId id) const { return nodes_[id].action; }
  int depth(PathId id) const { return nodes_[id].depth; }
  std::uint64_t hash(PathId id) const { return nodes_[id].hash; }  // HashPath of its path
  Path PathOf(PathId id) const;

  int num_actions() const { return num_actions_; }
  int size() const { return static_cast<int>(nodes_.size()); }

 private:
  struct Node {
    std::uint64_t hash;
    PathId parent;
    std::int32_t first_slot;  // where this node's child slots begin, or -1 while it has none
    std::int16_t action;
    std::int16_t depth;
  };

  int num_actions_;
  std::vector<Node> nodes_;
  std::vector<PathId> slots_;
};

}  // namespace prospect::planner
