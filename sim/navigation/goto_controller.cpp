#include "sim/navigation/goto_controller.h"

#include <algorithm>
#include <cmath>

namespace prospect::sim {
namespace {

constexpr double kTurnGain = 3.0;     // 1/s
constexpr double kDriveGain = 2.0;    // 1/s
constexpr double kCreep = 0.08;       // m/s, so that braking never ends short of the object
constexpr double kStopMargin = 0.06;  // m inside the reach at which the robot means to stand

double Ramp(double from, double to, double most) {
  return from + std::clamp(to - from, -most, most);
}

}  // namespace

LegNoise DrawLegNoise(const NavigationParameters& parameters, base::Random random) {
  LegNoise noise;
  noise.heading = parameters.heading_noise * random.BoundedNormal();
  noise.speed = 1.0 + parameters.speed_noise * random.BoundedNormal();
  return noise;
}

void GotoController::Begin(double x, double y, const LegNoise& noise) {
  x_ = x;
  y_ = y;
  noise_ = noise;
  command_ = {};
  driving_ = false;
}

Twist2 GotoController::Update(const NavigationParameters& parameters, const Pose2& pose, double gap,
                              double dt) {
  const double bearing = std::atan2(y_ - pose.y, x_ - pose.x);
  const double error = WrapAngle(bearing + noise_.heading - pose.yaw);
  if (std::abs(error) < parameters.aim_tolerance) driving_ = true;
  Twist2 wish;
  const double gain = driving_ ? kDriveGain : kTurnGain;
  wish.turn = std::clamp(gain * error, -parameters.turn_rate, parameters.turn_rate);
  if (driving_) {
    const double room = std::max(0.0, gap - (parameters.reach - kStopMargin));
    const double braking = std::sqrt(2 * parameters.acceleration * room) + kCreep;
    wish.forward = std::min(parameters.speed * noise_.speed, braking);
  }
  command_.forward = Ramp(command_.forward, wish.forward, parameters.acceleration * dt);
  command_.turn = Ramp(command_.turn, wish.turn, parameters.turn_acceleration * dt);
  return command_;
}

}  // namespace prospect::sim
