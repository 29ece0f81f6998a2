#include "services/console/services_view.h"

#include <algorithm>
#include <cmath>

namespace prospect::services::console {
namespace {

using nlohmann::json;

constexpr std::int64_t kDeadUs = 3'000'000, kForgottenUs = 60'000'000;
constexpr std::size_t kMostPeers = 2048;

const char* StateText(std::int8_t state) {
  static const char* const names[] = {"unknown", "starting", "ready", "busy", "leaving", "fault"};
  return state >= 0 && state <= health_t::STATE_FAULT ? names[state] : "unknown";
}

double Rounded(double number) { return std::isfinite(number) ? std::round(10 * number) / 10 : 0; }

}  // namespace

bool ServicesView::Alive(const Peer& peer, std::int64_t now_us) {
  return peer.health.state != health_t::STATE_DRAINING && now_us - peer.heard_us < kDeadUs;
}

// Who is gone for a minute is of no interest any more, and a bus on which ids never end must not
// fill the memory.
void ServicesView::Forget(std::int64_t now_us) {
  std::erase_if(peers_,
                [&](const auto& entry) { return now_us - entry.second.heard_us > kForgottenUs; });
  std::erase_if(servers_,
                [&](const auto& entry) { return now_us - entry.second.heard_us > kForgottenUs; });
}

void ServicesView::Hear(const health_t& health, std::int64_t now_us) {
  const auto known = peers_.find(health.instance_id);
  if (known == peers_.end()) {
    Forget(now_us);
    if (peers_.size() >= kMostPeers) return;
    peers_[health.instance_id] = {health, now_us};
    return;
  }
  known->second.health = health;
  known->second.heard_us = now_us;
}

void ServicesView::Hear(const model_info_t& info, std::int64_t now_us) {
  if (!servers_.contains(info.server_id) && servers_.size() >= kMostPeers) return;
  Server& server = servers_[info.server_id];
  server.info = info;
  server.heard_us = now_us;
  if (server.then_us == 0 || now_us < server.then_us) server.then = info, server.then_us = now_us;
  const std::int64_t passed_us = now_us - server.then_us;
  if (passed_us < 900'000) return;
  server.evaluations_per_second = 1e6 *
                                  static_cast<double>(info.evaluations - server.then.evaluations) /
                                  static_cast<double>(passed_us);
  server.then = info;
  server.then_us = now_us;
}

json ServicesView::ToJson(std::int64_t now_us) {
  Forget(now_us);
  json services = json::array(), servers = json::array();
  for (const auto& [id, peer] : peers_) {
    const health_t& health = peer.health;
    json counters = json::object();
    for (const auto& counter : health.counters) counters[counter.name] = counter.value;
    services.push_back({{"id", std::to_string(id)},
                        {"service", health.service},
                        {"host", health.host},
                        {"pid", health.pid},
                        {"state", Alive(peer, now_us) ? StateText(health.state)
                                  : health.state == health_t::STATE_DRAINING ? "left"
                                                                             : "silent"},
                        {"alive", Alive(peer, now_us)},
                        {"age_s", Rounded(1e-6 * static_cast<double>(now_us - peer.heard_us))},
                        {"note", health.message},
                        {"queue", health.queue},
                        {"cpu_s", Rounded(health.cpu_seconds)},
                        {"rss_mb", Rounded(static_cast<double>(health.rss_kb) / 1024)},
                        {"refused", health.refused},
                        {"counters", counters}});
  }
  for (const auto& [id, server] : servers_) {
    if (now_us - server.heard_us > kDeadUs) continue;
    const model_info_t& info = server.info;
    servers.push_back({{"id", std::to_string(id)},
                       {"engine", info.engine},
                       {"task", info.task},
                       {"judges", info.judges != 0},
                       {"threshold", info.refusal_threshold},
                       {"queue", info.queue},
                       {"queue_age_ms", Rounded(info.queue_age_ms)},
                       {"batch_ms", Rounded(info.batch_ms)},
                       {"evaluations", info.evaluations},
                       {"cache_hits", info.cache_hits},
                       {"per_second", Rounded(server.evaluations_per_second)},
                       {"batches", info.batch_histogram}});
  }
  return {{"services", services}, {"servers", servers}};
}

int ServicesView::Alive(const std::string& service, std::int64_t now_us) const {
  return static_cast<int>(std::count_if(peers_.begin(), peers_.end(), [&](const auto& entry) {
    return entry.second.health.service == service && Alive(entry.second, now_us);
  }));
}

std::vector<int> ServicesView::PidsOn(const std::string& host, const std::string& service,
                                      std::int64_t now_us) const {
  std::vector<int> pids;
  for (const auto& [id, peer] : peers_) {
    if (peer.health.service == service && peer.health.host == host && Alive(peer, now_us))
      pids.push_back(peer.health.pid);
  }
  return pids;
}

std::int64_t ServicesView::AnyServer(std::int64_t weights_hash, std::int64_t now_us) const {
  for (const auto& [id, server] : servers_) {
    if (now_us - server.heard_us < kDeadUs &&
        (weights_hash == 0 || server.info.weights_hash == weights_hash))
      return id;
  }
  return 0;
}

int ServicesView::Queue(std::int64_t now_us) const {
  int most = 0;
  for (const auto& [id, server] : servers_) {
    if (now_us - server.heard_us < kDeadUs) most = std::max(most, server.info.queue);
  }
  return most;
}

}  // namespace prospect::services::console
