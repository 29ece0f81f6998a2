#include "planner/path_tree.h"

#include <algorithm>
#include <stdexcept>

namespace prospect::planner {

PathTree::PathTree(int num_actions) : num_actions_(num_actions) {
  if (num_actions < 1 || num_actions > kMaxActions) {
    throw std::invalid_argument("a path tree needs 1 to 255 actions");
  }
  nodes_.push_back({kRootHash, kNoPath, -1, -1, 0});
}

PathId PathTree::Find(PathId parent, int action) const {
  const std::int32_t first_slot = nodes_[parent].first_slot;
  return first_slot < 0 ? kNoPath : slots_[first_slot + action];
}

PathId PathTree::Find(const Path& path) const {
  PathId id = kRoot;
  for (const std::uint8_t action : path) {
    if (action >= num_actions_) return kNoPath;
    id = Find(id, action);
    if (id == kNoPath) return kNoPath;
  }
  return id;
}

PathId PathTree::Add(PathId parent, int action) {
  if (nodes_[parent].first_slot < 0) {
    nodes_[parent].first_slot = static_cast<std::int32_t>(slots_.size());
    slots_.resize(slots_.size() + num_actions_, kNoPath);
  }
  PathId& slot = slots_[nodes_[parent].first_slot + action];
  if (slot == kNoPath) {
    slot = size();
    const Node& above = nodes_[parent];
    nodes_.push_back({ExtendHash(above.hash, action), parent, -1, static_cast<std::int16_t>(action),
                      static_cast<std::int16_t>(above.depth + 1)});
  }
  return slot;
}

PathId PathTree::Add(const Path& path) {
  if (!Valid(path)) throw std::invalid_argument("no path of this task: " + ToString(path));
  PathId id = kRoot;
  for (const std::uint8_t action : path) id = Add(id, action);
  return id;
}

bool PathTree::Valid(const Path& path) const {
  return path.size() <= kMaxPathLength && std::all_of(path.begin(), path.end(), [this](int action) {
           return action < num_actions_;
         });
}

Path PathTree::PathOf(PathId id) const {
  Path path(depth(id));
  for (std::size_t i = path.size(); i-- > 0; id = parent(id)) {
    path[i] = static_cast<std::uint8_t>(action(id));
  }
  return path;
}

}  // namespace prospect::planner
