#include "services/replay/log_player.h"

#include <algorithm>
#include <optional>

#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/signals.h"
#include "services/from_log/event_log.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kListenMs = 1200;  // everybody of ours says something once a second
constexpr std::int64_t kLongestTurnMs = 100;

bool IsCommand(const std::string& channel) {
  return channel == ChannelOf<action_command_t>() || channel == ChannelOf<sim_command_t>();
}

class Player {
 public:
  explicit Player(const PlayOptions& options)
      : options_(options), log_(options.log), bus_(options.bus) {
    subscription_ = bus_.SubscribeAll([this](const RawMessage& message) {
      if (message.channel == "LCM_SELF_TEST") return;
      ++heard_;
      channel_ = message.channel;
    });
  }

  PlayResult Run() {
    PauseUntil(SteadyUs() + 1000 * kListenMs);
    const std::int64_t start_us = SteadyUs();
    std::optional<std::int64_t> first_us;
    for (LogEvent event; !StopRequested() && log_.Next(event);) {
      if (!options_.with_commands && IsCommand(event.channel)) {
        ++result_.commands_left_out;
        continue;
      }
      const std::int64_t since_us = event.utime - first_us.value_or(event.utime);
      if (!first_us) first_us = event.utime;
      PauseUntil(start_us +
                 static_cast<std::int64_t>(static_cast<double>(since_us) / options_.speed));
      if (!StopRequested() && bus_.PublishRaw(event.channel, event.bytes)) ++result_.played;
    }
    result_.damaged = log_.damaged();
    result_.interrupted = StopRequested();
    return result_;
  }

 private:
  // A bus hears its own messages: who hears more than it has sent is not alone.
  void RequireToBeAlone() const {
    if (heard_ <= result_.played) return;
    throw ExitError(kExitBusInUse,
                    "somebody else speaks on " + bus_.url() + " (" + channel_ +
                        "): a recording is never played beside a deployment; name another bus "
                        "with --bus");
  }

  void PauseUntil(std::int64_t end_us) {
    do {
      const std::int64_t left_ms = (end_us - SteadyUs()) / 1000;
      bus_.Poll(static_cast<int>(std::clamp<std::int64_t>(left_ms, 0, kLongestTurnMs)));
      RequireToBeAlone();
    } while (SteadyUs() < end_us && !StopRequested());
  }

  const PlayOptions options_;
  EventLog log_;
  Bus bus_;
  PlayResult result_;
  std::int64_t heard_ = 0;
  std::string channel_;  // of the latest message heard
  Subscription subscription_;
};

}  // namespace

PlayResult PlayLog(const PlayOptions& options) { return Player(options).Run(); }

}  // namespace prospect::services
