#include "planner/foreign_rollouts.h"

#include <algorithm>

namespace prospect::planner {

void ForeignRollouts::Hear(std::uint64_t writer, PathId id, std::int64_t now_us) {
  for (Rollout& rollout : rollouts_) {
    if (rollout.writer != writer || !IsBelow(id, rollout.leaf)) continue;
    Count(id, rollout.leaf, 1);
    rollout.leaf = id;
    rollout.heard_us = now_us;
    return;
  }
  rollouts_.push_back({writer, id, now_us});
  Count(id, kNoPath, 1);
}

void ForeignRollouts::Settle(std::uint64_t writer, std::int64_t oldest_us,
                             const std::function<bool(PathId)>& answered) {
  const auto over = [&](const Rollout& rollout) {
    const bool settled = rollout.writer == writer && answered(rollout.leaf);
    if (!settled && rollout.heard_us >= oldest_us) return false;
    Count(rollout.leaf, kNoPath, -1);
    return true;
  };
  rollouts_.erase(std::remove_if(rollouts_.begin(), rollouts_.end(), over), rollouts_.end());
}

// From `leaf` up to, but not at, `above`.
void ForeignRollouts::Count(PathId leaf, PathId above, int sign) {
  if (static_cast<int>(counts_.size()) < paths_->size()) counts_.resize(paths_->size());
  for (PathId id = leaf; id != above && id != kNoPath; id = paths_->parent(id)) counts_[id] += sign;
}

bool ForeignRollouts::IsBelow(PathId id, PathId above) const {
  while (id > above) id = paths_->parent(id);
  return id == above;
}

}  // namespace prospect::planner
