#include "services/common/robot_hold.h"

namespace prospect::services {

std::string BusyText(std::int64_t holder) {
  return "busy, held by executive " + std::to_string(holder);
}

void RobotHold::Hear(const health_t& health, std::int64_t now_ms) {
  if (holder_ == 0 || health.instance_id != holder_) return;
  heard_ms_ = now_ms;
  leaving_ = health.state == health_t::STATE_DRAINING;
}

std::string RobotHold::BusyFor(std::int64_t sender) const {
  return holder_ == 0 || holder_ == sender ? "" : BusyText(holder_);
}

void RobotHold::Take(std::int64_t sender, std::int64_t now_ms) {
  holder_ = sender;
  heard_ms_ = now_ms;
  leaving_ = false;
}

bool RobotHold::Lapsed(std::int64_t now_ms) const {
  return holder_ != 0 && (leaving_ || now_ms - heard_ms_ > kSilentMs);
}

}  // namespace prospect::services
