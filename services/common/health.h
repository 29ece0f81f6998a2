#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "services/common/bus.h"
#include "services/common/clock.h"

namespace prospect::services {

/// From now on each HealthBeacon writes its instance id to this file when it is made, so that
/// others on this machine can ask for this very process. Empty: none does.
void SetInstanceFile(const std::string& path);

/// The id in such a file. @throws ExitError (kExitDataFile) when there is none yet
std::int64_t ReadInstanceFile(const std::string& path);

/// Says on HEALTH that this process lives: once a second and on change. Adds the bus's counters of
/// refused messages (and of chaos, if any), memory and processor time by itself. Call Tick() in
/// each turn of the loop; nothing runs by itself. Belongs to the bus's thread; the bus must outlive
/// it.
class HealthBeacon {
 public:
  /// Starts in STATE_STARTING with a random instance id. @param service "simulator", "model",
  /// "worker", "executive" @throws base::DiskError when the instance file cannot be written
  HealthBeacon(Bus& bus, std::string service);

  /// Random per start; other messages of this process carry it too (server_id, executive_id, ...).
  std::int64_t instance_id() const { return message_.instance_id; }

  /// A STATE_ of health_t, and a note on what is wrong (empty: nothing). A change is published at
  /// the next Tick().
  void SetState(std::int8_t state, const std::string& note = "");
  std::int8_t state() const { return message_.state; }

  /// Work waiting, items. Told with the next beat, no sooner.
  void SetQueue(std::int32_t queue) { message_.queue = queue; }

  /// A count of the service's own, such as "rollouts". Told with the next beat.
  void SetCounter(const std::string& name, std::int64_t value) { counters_[name] = value; }

  /// Publishes when a second has passed or the state or note changed.
  void Tick();

  /// Publishes now: the last word before an orderly end (STATE_DRAINING).
  void PublishNow();

 private:
  void FillCounters();

  Bus& bus_;
  health_t message_{};
  std::map<std::string, std::int64_t> counters_;
  Periodic beat_{1000};
};

}  // namespace prospect::services
