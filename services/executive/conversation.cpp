#include "services/executive/conversation.h"

#include <algorithm>

#include "services/common/signals.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kLongestWaitMs = 20;

}  // namespace

Conversation::Conversation(Bus& bus)
    : bus_(bus), health_(bus, "executive"), monitor_(bus), view_(bus) {
  health_.SetState(health_t::STATE_READY);
}

void Conversation::Turn(int wait_ms) {
  bus_.Poll(wait_ms);
  health_.Tick();
  if (StopRequested()) throw ExitError(kExitInterrupted, "interrupted");
}

bool Conversation::Until(const std::function<bool()>& condition, std::int64_t timeout_ms,
                         const std::function<void()>& repeat, std::int64_t period_ms) {
  const std::int64_t deadline_ms = SteadyMs() + timeout_ms;
  Periodic due(period_ms);
  while (!condition()) {
    const std::int64_t now_ms = SteadyMs();
    if (now_ms >= deadline_ms) return false;
    if (repeat && due.Due(now_ms)) repeat();
    const std::int64_t left = std::min(kLongestWaitMs, deadline_ms - now_ms);
    Turn(static_cast<int>(repeat ? std::min(left, due.Remaining(now_ms)) : left));
  }
  return true;
}

}  // namespace prospect::services
