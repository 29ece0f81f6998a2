#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/common/bus.h"

namespace prospect::services {

/// Who is alive on the bus, by their HEALTH. A process silent for 3 s is dead, and so is one that
/// said STATE_DRAINING. Judged by this host's steady clock and never by times in messages. Belongs
/// to the bus's thread; the bus must outlive it.
class HealthMonitor {
 public:
  /// Silence after which a process counts as dead, milliseconds.
  static constexpr std::int64_t kDeadMs = 3000;

  struct Peer {
    health_t health;        ///< its latest message
    std::int64_t heard_ms;  ///< when, on SteadyMs()'s clock
  };

  /// Subscribes to HEALTH.
  explicit HealthMonitor(Bus& bus);

  /// Those alive, of one service ("worker"; empty: all), by instance id. `foreign` deployments are
  /// left out: see IsForeign().
  std::vector<Peer> Alive(const std::string& service = "") const;

  /// Whether this instance is alive. False for ids never heard.
  bool IsAlive(std::int64_t instance_id) const;

  /// The latest word of an instance, dead or alive; null when never heard.
  const Peer* Find(std::int64_t instance_id) const;

  /// A live peer of another deployment, or nothing. Always nothing when this process has no
  /// deployment id (0).
  std::optional<Peer> Foreign() const;

  /// Polls the bus for `listen_ms` (0: judges by what was heard before, without polling) and
  /// throws when another deployment lives there. To be called once, before a service says READY.
  /// @throws ExitError (kExitBusInUse) that names the foreign process and what to do
  void RequireOwnBus(std::int64_t listen_ms = 1200);

 private:
  static bool IsForeign(const health_t& health);

  Bus& bus_;
  std::map<std::int64_t, Peer> peers_;
  Subscription subscription_;
};

}  // namespace prospect::services
