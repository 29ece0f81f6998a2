#include "services/binding/server_list.h"

#include <algorithm>

namespace prospect::services {
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

namespace {

// The hash of the path's first actions.
std::uint64_t PrefixHash(const planner::Path& path, int length) {
  std::uint64_t hash = planner::kRootHash;
  for (int i = 0; i < length && i < static_cast<int>(path.size()); ++i)
    hash = planner::ExtendHash(hash, path[static_cast<std::size_t>(i)]);
  return hash;
}

// Those not under suspicion, or all when there is no other.
std::vector<model_info_t> Trusted(const std::vector<model_info_t>& live,
                                  const ServerConduct& conduct) {
  std::vector<model_info_t> trusted;
  for (const auto& info : live) {
    if (!conduct.Suspect(info.server_id)) trusted.push_back(info);
  }
  return trusted.empty() ? live : trusted;
}

// The place of the server that has least to do, if paths wait for more than a batch with the first
// and for a batch less with that one; else 0.
std::size_t SpillOver(const std::vector<model_info_t>& ranked, const ServerConduct& conduct) {
  const auto waits_less = [&](const model_info_t& a, const model_info_t& b) {
    return conduct.WaitMs(a.server_id) < conduct.WaitMs(b.server_id);
  };
  const auto least = std::min_element(ranked.begin(), ranked.end(), waits_less);
  const double first_ms = conduct.WaitMs(ranked.front().server_id);
  const double batch_ms = ranked.front().batch_ms;
  const bool worth = first_ms > batch_ms && first_ms - conduct.WaitMs(least->server_id) > batch_ms;
  return worth ? static_cast<std::size_t>(least - ranked.begin()) : 0;
}

}  // namespace

std::int64_t ServerList::Choose(const planner::Path& path, int attempt, std::int64_t weights_hash,
                                std::int64_t now_ms, const ServerConduct& conduct) const {
  auto ranked = Trusted(Live(weights_hash, now_ms), conduct);
  if (ranked.empty()) return 0;
  const std::uint64_t prefix = PrefixHash(path, prefix_length_);
  const auto rank = [&](const model_info_t& info) {
    return planner::HashCombine(prefix, static_cast<std::uint64_t>(info.server_id));
  };
  std::sort(ranked.begin(), ranked.end(),
            [&](const auto& a, const auto& b) { return rank(a) > rank(b); });
  const std::size_t first = attempt == 0 ? SpillOver(ranked, conduct) : 0;
  return ranked[(first + static_cast<std::size_t>(attempt)) % ranked.size()].server_id;
}

}  // namespace prospect::services
