#include "planner/rollout_claims.h"

#include <algorithm>
#include <limits>

namespace prospect::planner {
namespace {

// Parts smaller than this are not halved again: the last few rollouts are not worth a round each.
constexpr std::int64_t kSmallPart = 4;

std::int64_t CeilDiv(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

// What one of `workers` may take of `left`.
std::int64_t PartOf(std::int64_t left, std::int64_t workers) {
  if (left <= 0) return 0;
  const std::int64_t even = CeilDiv(left, workers);
  return std::max(std::min(even, kSmallPart), CeilDiv(left, 2 * workers));
}

}  // namespace

struct RolloutClaims::Peers {
  std::int64_t claimed = 0;
  std::int64_t at_work = 0;
  std::int64_t lagging = 0;  // at work, and not heard at this round
  std::int64_t lowest_round = std::numeric_limits<std::int64_t>::max();
};

RolloutClaims::Peers RolloutClaims::Survey(const std::vector<WriterView>& peers) const {
  Peers found;
  for (const WriterView& peer : peers) {
    const bool at_work = peer.live && !peer.announced.finished;
    const std::int64_t done = std::max(peer.rollouts, peer.announced.rollouts);
    found.claimed += at_work ? std::max(peer.announced.claimed, done) : done;
    if (!at_work) continue;
    ++found.at_work;
    if (peer.announced.round < round_) ++found.lagging;
    found.lowest_round = std::min(found.lowest_round, std::max(round_, peer.announced.round));
  }
  return found;
}

void RolloutClaims::Share(std::int64_t begun, std::int64_t now_us) {
  if (shared_) return;
  shared_ = true;
  claimed_ = std::max(begun, std::min(kFirstClaim, samples_));
  renewed_us_ = now_us;
}

void RolloutClaims::Renew(std::int64_t begun, const std::vector<WriterView>& peers,
                          std::int64_t now_us) {
  if (!shared_ || !announced_) return;
  const Peers all = Survey(peers);
  if (all.lagging > 0 && now_us - renewed_us_ < kPatienceUs) return;
  const std::int64_t workers = all.at_work + 1;
  std::int64_t left = samples_ - all.claimed - begun;
  // Set aside for those not heard, but not all: somebody must do the last ones.
  left = std::max(std::min<std::int64_t>(left, 1), left - all.lagging * PartOf(left, workers));
  const std::int64_t part = std::min(PartOf(left, workers), std::max(kFirstClaim, begun));
  const std::int64_t claim = std::max(claimed_, begun + part);
  const std::int64_t round = all.at_work > 0 ? all.lowest_round + 1 : round_ + 1;
  // Alone and with nothing more to claim, there is nothing to tell.
  if (all.at_work == 0 && claim == claimed_) return;
  claimed_ = claim;
  round_ = round;
  renewed_us_ = now_us;
  announced_ = false;
}

}  // namespace prospect::planner
