#include "services/executive/conversation.h"

#include <algorithm>

#include "services/common/signals.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kLongestWaitMs = 20;
// HEALTH comes once a second.
constexpr std::int64_t kHealthMs = 1500;

}  // namespace

Conversation::Conversation(Bus& bus, const std::string& service)
    : bus_(bus), health_(bus, service), monitor_(bus), view_(bus) {
  health_.SetState(health_t::STATE_READY);
}

void Conversation::Turn(int wait_ms) {
  bus_.Poll(wait_ms);
  health_.Tick();
  if (StopRequested()) throw ExitError(kExitInterrupted, "interrupted");
  RequireWorld();
}

std::set<std::int64_t> Conversation::LiveWorlds() const {
  std::set<std::int64_t> live;
  for (const auto& peer : monitor_.Alive("simulator")) live.insert(peer.health.instance_id);
  return live;
}

void Conversation::HoldWorld() {
  Until([this] { return !LiveWorlds().empty(); }, kHealthMs);
  worlds_ = LiveWorlds();
}

void Conversation::RequireWorld() const {
  if (worlds_.empty()) return;
  const std::set<std::int64_t> live = LiveWorlds();
  const bool newcomer =
      std::any_of(live.begin(), live.end(), [this](auto id) { return worlds_.count(id) == 0; });
  if (newcomer) {
    throw ExitError(kExitServiceLost,
                    "the simulator or robot was started again or another one came: the scene that "
                    "was planned for is gone; run the episode again");
  }
  // On a lossy network three signs of life may go missing in a row; of all its messages, hardly.
  const bool silent = SteadyMs() - view_.world_heard_ms() > HealthMonitor::kDeadMs;
  if (live.empty() && silent) {
    throw ExitError(kExitServiceLost,
                    "the simulator or robot fell silent for 3 s: see its log, start it again "
                    "(./prospect up), then run the episode again");
  }
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
