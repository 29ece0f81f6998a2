#pragma once

#include <cstdint>
#include <string>

#include "lcmtypes/messages.h"

namespace prospect::services {

/// Who alone may command a robot. The first sender whose command is accepted holds it, until its
/// HEALTH says that it leaves (STATE_DRAINING) or neither HEALTH nor an accepted command has come
/// from it for 3 s. Judged by the steady clock, in milliseconds. Plain data, one thread; senders
/// are instance ids of HEALTH.
class RobotHold {
 public:
  /// Silence after which the holder counts as gone.
  static constexpr std::int64_t kSilentMs = 3000;

  /// To be called for every HEALTH message heard.
  void Hear(const health_t& health, std::int64_t now_ms);

  /// "busy, held by executive 17" for everybody but the holder; empty: `sender` may command.
  std::string BusyFor(std::int64_t sender) const;

  /// A command of `sender`, whom BusyFor lets pass, was accepted: it holds the robot.
  void Take(std::int64_t sender, std::int64_t now_ms);

  /// Whether it is held by somebody who has left or fallen silent: what moves must be stopped, then
  /// Free() called.
  bool Lapsed(std::int64_t now_ms) const;
  void Free() { holder_ = 0; }

  /// 0: nobody.
  std::int64_t holder() const { return holder_; }

 private:
  std::int64_t holder_ = 0;
  std::int64_t heard_ms_ = 0;
  bool leaving_ = false;
};

/// "busy, held by executive 17".
std::string BusyText(std::int64_t holder);

}  // namespace prospect::services
