#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/health.h"
#include "services/common/health_monitor.h"
#include "services/common/robot_hold.h"
#include "services/player/video_scene.h"

namespace prospect::services {

/// Plays a video on the bus in a simulator's place: TASK at 1 Hz, each picture as OBSERVATION with
/// its LABEL when it is due, the last one again and again after the end. Hears SIM_COMMAND of one
/// sender at a time (RobotHold): RESET plays from the beginning as another episode, PAUSE and
/// RESUME hold the picture. It carries no action out.
///
/// One thread: construct, then call Turn() until it is time to stop. The bus must outlive it.
class Player {
 public:
  /// @param speed 1: as it was filmed @param loop from the beginning again after the end, as the
  /// next episode. Throws model::DataError.
  Player(Bus& bus, const VideoChoice& choice, double speed, bool loop);

  void Turn();
  /// The last word on HEALTH.
  void Leave();

  HealthMonitor& monitor() { return monitor_; }

 private:
  using Clock = std::chrono::steady_clock;

  void OnCommand(const sim_command_t& command);
  void ShowNext();
  void Publish();
  int TimeoutMs() const;

  Bus& bus_;
  HealthBeacon health_;
  HealthMonitor monitor_;
  RobotHold hold_;
  VideoScene scene_;
  double speed_;
  bool loop_;
  bool paused_ = false, ended_ = false;
  std::int64_t command_ = 0, sender_ = 0;  // the latest carried out
  std::int64_t shown_us_ = 0;              // time in the video of the picture shown
  Clock::time_point due_;                  // of the next picture
  Periodic task_due_{1000};
  Periodic repeat_due_{500};
  std::vector<Subscription> subscriptions_;
};

}  // namespace prospect::services
