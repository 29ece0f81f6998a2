#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>

#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/health.h"
#include "services/common/health_monitor.h"
#include "services/executive/bus_view.h"

namespace prospect::services {

/// The executive's side of the bus: its health, who else lives, what the world looks like, and
/// waiting done right: every wait goes on listening, keeps the executive's own HEALTH alive and
/// ends on a stop signal. Belongs to one thread; the bus must outlive it.
class Conversation {
 public:
  /// @param service what HEALTH calls this process
  explicit Conversation(Bus& bus, const std::string& service = "executive");

  /// Listens for at most `wait_ms`. Throws ExitError: kExitInterrupted after SIGINT or SIGTERM, and
  /// kExitServiceLost as HoldWorld(), ClaimRobot() and HoldTask() say.
  void Turn(int wait_ms);

  /// From now on the world is the one whose simulator or robot lives at this moment: when it falls
  /// silent on all its channels, or another takes its place (a simulator that was started again
  /// knows nothing of what was done), every wait ends with kExitServiceLost. Nothing is watched
  /// where nobody says HEALTH as "simulator".
  void HoldWorld();

  /// From now on this process commands the robot: while ACTION_STATUS says that another executive
  /// holds it, every wait ends with kExitServiceLost, "busy, held by executive 17". One that is not
  /// heard any more is waited for until the robot is free of it, 4 s at most.
  void ClaimRobot();

  /// From now on TASK must stay as it is at this moment: every wait ends with kExitServiceLost when
  /// its table or numbers change, since nothing that was planned holds any more.
  void HoldTask();

  /// Listens until `condition` holds (true) or `timeout_ms` have passed (false). `repeat`, if any,
  /// is called at once and then every `period_ms`: for what must be said again until it is heard.
  /// Throws as Turn does, and what `repeat` throws.
  bool Until(const std::function<bool()>& condition, std::int64_t timeout_ms,
             const std::function<void()>& repeat = nullptr, std::int64_t period_ms = 100);

  /// Stamps a message and publishes it.
  template <class T>
  void Say(T message) {
    message.utime = UtimeNow();
    bus_.Publish(message);
  }

  Bus& bus() { return bus_; }
  HealthBeacon& health() { return health_; }
  HealthMonitor& monitor() { return monitor_; }
  BusView& view() { return view_; }
  std::int64_t id() const { return health_.instance_id(); }
  /// For the next command of this process, to a robot or a simulator: ids grow, since a lower one
  /// is old news.
  std::int64_t NextCommandId() { return ++last_command_id_; }

 private:
  std::set<std::int64_t> LiveWorlds() const;
  void RequireWorld() const;
  bool HeldByAnother() const;
  void RequireClaim() const;
  void RequireTask() const;

  Bus& bus_;
  HealthBeacon health_;
  HealthMonitor monitor_;
  BusView view_;
  std::set<std::int64_t> worlds_;  // instances of "simulator" that lived at HoldWorld()
  bool claims_robot_ = false;
  std::int64_t task_hash_ = 0;  // of TASK at HoldTask(); 0: it was not called
  std::int64_t last_command_id_ = 0;
};

}  // namespace prospect::services
