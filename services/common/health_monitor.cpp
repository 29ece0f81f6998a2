#include "services/common/health_monitor.h"

#include "services/common/clock.h"
#include "services/common/ids.h"

namespace prospect::services {
namespace {

bool IsFresh(const HealthMonitor::Peer& peer, std::int64_t now_ms) {
  return peer.health.state != health_t::STATE_DRAINING &&
         now_ms - peer.heard_ms < HealthMonitor::kDeadMs;
}

ExitError InUse(const HealthMonitor::Peer& foreign, const std::string& url) {
  const health_t& health = foreign.health;
  return ExitError(
      kExitBusInUse,
      "the bus " + url + " is in use by another deployment (" + health.service + ", pid " +
          std::to_string(health.pid) + " on " + health.host +
          "): stop it, or use another port, such as --bus udpm://239.255.76.67:7668?ttl=0");
}

}  // namespace

HealthMonitor::HealthMonitor(Bus& bus) : bus_(bus) {
  subscription_ = bus.Subscribe<health_t>([this](const health_t& health) {
    const std::int64_t now_ms = SteadyMs();
    // A bus lives longer than most processes on it: those long dead are forgotten.
    constexpr std::int64_t kForgetMs = 60000;
    for (auto peer = peers_.begin(); peer != peers_.end();) {
      peer = now_ms - peer->second.heard_ms > kForgetMs ? peers_.erase(peer) : std::next(peer);
    }
    peers_[health.instance_id] = {health, now_ms};
  });
}

bool HealthMonitor::IsForeign(const health_t& health) {
  const std::int64_t own = DeploymentId();
  // Whoever has no deployment joins all: a worker that somebody started on another machine.
  return own != 0 && health.deployment_id != 0 && health.deployment_id != own;
}

std::vector<HealthMonitor::Peer> HealthMonitor::Alive(const std::string& service) const {
  std::vector<Peer> alive;
  const std::int64_t now_ms = SteadyMs();
  for (const auto& [id, peer] : peers_) {
    if (!IsFresh(peer, now_ms) || IsForeign(peer.health)) continue;
    if (service.empty() || peer.health.service == service) alive.push_back(peer);
  }
  return alive;
}

bool HealthMonitor::IsAlive(std::int64_t instance_id) const {
  const Peer* peer = Find(instance_id);
  return peer && IsFresh(*peer, SteadyMs());
}

const HealthMonitor::Peer* HealthMonitor::Find(std::int64_t instance_id) const {
  const auto found = peers_.find(instance_id);
  return found == peers_.end() ? nullptr : &found->second;
}

std::optional<HealthMonitor::Peer> HealthMonitor::Foreign() const {
  const std::int64_t now_ms = SteadyMs();
  for (const auto& [id, peer] : peers_) {
    if (IsFresh(peer, now_ms) && IsForeign(peer.health)) return peer;
  }
  return std::nullopt;
}

void HealthMonitor::RequireOwnBus(std::int64_t listen_ms) {
  const std::int64_t end_ms = SteadyMs() + listen_ms;
  while (true) {
    if (const std::optional<Peer> foreign = Foreign()) throw InUse(*foreign, bus_.url());
    const std::int64_t left_ms = end_ms - SteadyMs();
    if (left_ms <= 0) return;
    bus_.Poll(static_cast<int>(left_ms));
  }
}

}  // namespace prospect::services
