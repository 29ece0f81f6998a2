#include "planner/child_lists.h"

namespace prospect::planner {

void ChildLists::Forget(PathId id) {
  if (id < static_cast<int>(lists_.size())) lists_[id] = List{};
}

void ChildLists::Open(PathId id, const PathTree& paths) {
  if (id >= static_cast<int>(lists_.size())) lists_.resize(paths.size());
  lists_[id] = {static_cast<std::int32_t>(entries_.size()), 0, 0};
}

void ChildLists::Append(const PathTree& paths, PathId id, int action, double q) {
  const std::uint64_t hash = ExtendHash(paths.hash(id), action);
  entries_.push_back({HashCombine(tie_seed_, hash), HashCombine(draw_seed_, hash), q,
                      paths.Find(id, action), static_cast<std::uint8_t>(action)});
  ++lists_[id].count;
  lists_[id].q_sum += q;
}

}  // namespace prospect::planner
