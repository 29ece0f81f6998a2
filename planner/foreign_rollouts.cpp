#include "planner/foreign_rollouts.h"

#include <algorithm>

namespace prospect::planner {
namespace {

// Forget goes over everything, so it does not do so for less than this.
constexpr std::int64_t kForgetStepUs = 20'000;

}  // namespace

void ForeignRollouts::Hear(std::uint64_t writer, PathId id, bool answered, std::int64_t now_us) {
  Rollouts& rollouts = rollouts_[writer];
  if (!Follow(&rollouts, writer, {id, answered, now_us})) {
    if (rollouts.empty()) rollouts_.erase(writer);
    return;
  }
  if (!answered) WaitAt(writer, id);
}

// Moves the rollout that came to `now.leaf`, or begins one. False if there is nothing new in that.
bool ForeignRollouts::Follow(Rollouts* rollouts, std::uint64_t writer, const Rollout& now) {
  Rollout* moved = nullptr;
  for (Rollout& rollout : *rollouts) {
    if (IsBelow(rollout.leaf, now.leaf)) return false;  // it has been here already
    if (!IsBelow(now.leaf, rollout.leaf)) continue;
    if (moved == nullptr || rollout.leaf > moved->leaf) moved = &rollout;
  }
  const PathId above = moved == nullptr ? kNoPath : moved->leaf;
  if (!statistics_->Announce(writer, now.leaf, above, 1)) return false;
  if (moved == nullptr) moved = &rollouts->emplace_back();
  *moved = now;
  return true;
}

void ForeignRollouts::WaitAt(std::uint64_t writer, PathId id) {
  const auto [waiting, first] = waiting_.try_emplace(id, writer);
  if (first || waiting->second == writer) return;
  const std::uint64_t leaves = std::max(waiting->second, writer);
  waiting->second = std::min(waiting->second, writer);
  GiveUp(leaves, id);
}

void ForeignRollouts::GiveUp(std::uint64_t writer, PathId id) {
  const auto found = rollouts_.find(writer);
  if (found == rollouts_.end()) return;
  Rollouts& rollouts = found->second;
  const auto there = std::find_if(rollouts.begin(), rollouts.end(),
                                  [id](const Rollout& rollout) { return rollout.leaf == id; });
  if (there == rollouts.end()) return;
  statistics_->Announce(writer, id, kNoPath, -1);
  rollouts.erase(there);
  const auto waiting = waiting_.find(id);
  if (waiting != waiting_.end() && waiting->second == writer) waiting_.erase(waiting);
}

std::uint64_t ForeignRollouts::Answer(PathId id) {
  const auto waiting = waiting_.find(id);
  if (waiting == waiting_.end()) return 0;
  const std::uint64_t writer = waiting->second;
  for (Rollout& rollout : rollouts_[writer]) {
    if (rollout.leaf == id) rollout.answered = true;
  }
  waiting_.erase(waiting);
  return writer;
}

void ForeignRollouts::Forget(std::int64_t oldest_us) {
  if (oldest_us - forgot_us_ < kForgetStepUs) return;
  forgot_us_ = oldest_us;
  for (auto& [writer, rollouts] : rollouts_) {
    const auto old = [&, of = writer](const Rollout& rollout) {
      if (rollout.heard_us >= oldest_us) return false;
      if (rollout.answered) return true;
      statistics_->Announce(of, rollout.leaf, kNoPath, -1);
      waiting_.erase(rollout.leaf);
      return true;
    };
    std::erase_if(rollouts, old);
  }
}

bool ForeignRollouts::IsBelow(PathId id, PathId above) const {
  while (id > above) id = paths_->parent(id);
  return id == above;
}

}  // namespace prospect::planner
