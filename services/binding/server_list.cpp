#include "services/binding/server_list.h"

namespace prospect::services {
namespace {

// After this many attempts in vain the next server is asked.
constexpr int kAttemptsEach = 3;

}  // namespace

void ServerList::Hear(const model_info_t& info, std::int64_t now_ms) {
  servers_[info.server_id] = {info, now_ms};
  for (auto it = servers_.begin(); it != servers_.end();) {
    it = now_ms - it->second.heard_ms > 10 * kSilentMs ? servers_.erase(it) : std::next(it);
  }
}

std::vector<model_info_t> ServerList::Live(std::int64_t weights_hash, std::int64_t now_ms) const {
  std::vector<model_info_t> live;
  for (const auto& [id, entry] : servers_) {
    if (now_ms - entry.heard_ms > kSilentMs) continue;
    if (weights_hash != 0 && entry.info.weights_hash != weights_hash) continue;
    live.push_back(entry.info);
  }
  return live;
}

std::int64_t ServerList::Choose(const planner::Path& path, int attempt, std::int64_t weights_hash,
                                std::int64_t now_ms) const {
  const auto live = Live(weights_hash, now_ms);
  if (live.empty()) return 0;
  const std::uint64_t prefix =
      path.empty() ? planner::kRootHash : planner::ExtendHash(planner::kRootHash, path.front());
  const auto shift = static_cast<std::uint64_t>(attempt / kAttemptsEach);
  return live[(prefix % live.size() + shift) % live.size()].server_id;
}

}  // namespace prospect::services
