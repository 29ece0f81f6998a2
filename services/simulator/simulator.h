#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/health.h"
#include "services/common/health_monitor.h"
#include "services/common/robot_hold.h"
#include "services/simulator/command_gate.h"
#include "services/simulator/scene.h"
#include "sim/task_factory.h"

namespace prospect::services {

struct SimulatorOptions {
  std::string task = sim::TaskNames().front();
  sim::TaskOptions scene;          ///< until a RESET says otherwise
  std::uint64_t seed = 0;          ///< of the first scene
  bool real_time = false;          ///< one tick in tick_seconds of wall clock
  double frames_per_second = 300;  ///< otherwise: pace that a bus carries without losing pictures
};

/// A simulated robot in its world, on the bus. Publishes TASK at 1 Hz, a picture (OBSERVATION) and
/// its LABEL each tick while something moves and repeats the latest while the world holds still,
/// and ACTION_STATUS on change and at 2 Hz. Carries out SIM_COMMAND and ACTION_COMMAND, each
/// command once, of one executive at a time (RobotHold): a running action is cancelled when its
/// executive's HEALTH falls silent for 3 s, and others may command from then on.
///
/// One thread: construct, then call Turn() until it is time to stop. The bus must outlive it.
class Simulator {
 public:
  /// Throws std::invalid_argument for an unknown task or scene parameters out of range.
  Simulator(Bus& bus, const SimulatorOptions& options);

  /// Waits for messages until the next thing is due, then does what is due.
  void Turn();

  /// Cancels what moves and says the last word on HEALTH.
  void Leave();

  HealthMonitor& monitor() { return monitor_; }

 private:
  using Clock = std::chrono::steady_clock;

  void OnSimCommand(const sim_command_t& command);
  void OnActionCommand(const action_command_t& command);
  void Reset(const sim_command_t& command);
  void Start(const action_command_t& command);
  void Cancel(const action_command_t& command);
  void Answer(const action_command_t& command, const std::string& refusal);
  void TickIfDue();
  void WatchHolder();
  void PublishFrame();
  void PublishStatus();
  void PublishTask();
  void PublishPeriodic();
  void FollowTask();
  void CancelRunning(const std::string& reason);
  int TimeoutMs() const;
  bool Ticking() const { return scene_.moving() && !paused_; }

  Bus& bus_;
  SimulatorOptions options_;
  HealthBeacon health_;
  HealthMonitor monitor_;
  Scene scene_;
  CommandGate sim_commands_;
  CommandGate action_commands_;
  RobotHold hold_;
  action_status_t status_{};
  bool paused_ = false;
  Clock::duration tick_period_;
  Clock::time_point next_tick_;
  int quick_repeats_left_ =
      0;  // of a picture just made, so that one lost datagram costs little time
  Periodic task_due_{1000};
  Periodic status_due_{500};
  Periodic repeat_due_{500};
  Periodic quick_repeat_due_{40};
  std::vector<Subscription> subscriptions_;
};

}  // namespace prospect::services
