#include "services/executive/conversation.h"

#include <algorithm>

#include "cli/installation.h"
#include "services/common/robot_hold.h"
#include "services/common/signals.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kLongestWaitMs = 20;
// HEALTH comes once a second, ACTION_STATUS twice.
constexpr std::int64_t kHealthMs = 1500;
constexpr std::int64_t kStatusMs = 1500;
// A holder that died holds for 3 s, and its end is told within another.
constexpr std::int64_t kFreeMs = RobotHold::kSilentMs + 1000;

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
  RequireClaim();
  RequireTask();
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
      std::any_of(live.begin(), live.end(), [this](auto id) { return !worlds_.contains(id); });
  if (newcomer) {
    throw ExitError(kExitServiceLost,
                    "the simulator or robot was started again or another one came: the scene that "
                    "was planned for is gone; run the episode again");
  }
  // On a lossy network three signs of life may go missing in a row; of all its messages, hardly.
  const bool silent = SteadyMs() - view_.world_heard_ms() > HealthMonitor::kDeadMs;
  if (live.empty() && silent) {
    throw ExitError(kExitServiceLost,
                    "the simulator or robot fell silent for 3 s: see its log, start it again (" +
                        cli::Typed("up") + "), then run the episode again");
  }
}

void Conversation::ClaimRobot() {
  Until([this] { return view_.holder_id().has_value(); }, kStatusMs);
  Until([this] { return !HeldByAnother() || monitor_.IsAlive(*view_.holder_id()); }, kFreeMs);
  claims_robot_ = true;
  RequireClaim();
}

bool Conversation::HeldByAnother() const {
  const std::int64_t holder = view_.holder_id().value_or(0);
  return holder != 0 && holder != id();
}

void Conversation::RequireClaim() const {
  if (!claims_robot_ || !HeldByAnother()) return;
  const HealthMonitor::Peer* peer = monitor_.Find(*view_.holder_id());
  const std::string who =
      peer ? " (pid " + std::to_string(peer->health.pid) + " on " + peer->health.host + ")" : "";
  throw ExitError(kExitServiceLost, BusyText(*view_.holder_id()) + who +
                                        ": wait until its episode is over, or stop it");
}

void Conversation::HoldTask() { task_hash_ = view_.task_hash(); }

void Conversation::RequireTask() const {
  if (task_hash_ == 0 || view_.task_hash() == task_hash_) return;
  throw ExitError(
      kExitServiceLost,
      "TASK has changed in the middle of the episode, so what was planned holds no more: "
      "run the episode again");
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
