#include "services/player/player.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "services/common/ids.h"

namespace prospect::services {
namespace {

constexpr int kLongestWaitMs = 40;

}  // namespace

Player::Player(Bus& bus, const VideoChoice& choice, double speed, bool loop)
    : bus_(bus),
      health_(bus, "simulator"),
      monitor_(bus),
      scene_(choice, RandomId()),
      speed_(speed),
      loop_(loop),
      due_(Clock::now()) {
  subscriptions_.push_back(
      bus_.Subscribe<health_t>([this](const health_t& health) { hold_.Hear(health, SteadyMs()); }));
  subscriptions_.push_back(
      bus_.Subscribe<sim_command_t>([this](const sim_command_t& command) { OnCommand(command); }));
  health_.SetState(health_t::STATE_READY);
}

void Player::OnCommand(const sim_command_t& command) {
  if (command.sender_id == sender_ && command.command_id <= command_) return;
  if (!hold_.BusyFor(command.sender_id).empty())
    return bus_.CountRefused(ChannelOf<sim_command_t>(), "busy");
  hold_.Take(command.sender_id, SteadyMs());
  sender_ = command.sender_id;
  command_ = command.command_id;
  paused_ = command.kind == sim_command_t::KIND_PAUSE;
  due_ = Clock::now();
  if (command.kind != sim_command_t::KIND_RESET) return;
  spdlog::info("from the beginning, as episode {}", command.episode_id);
  scene_.Restart(command.episode_id);
  ended_ = false;
  shown_us_ = 0;
}

void Player::ShowNext() {
  if (!scene_.Next()) {
    spdlog::info("the video has ended");
    ended_ = !loop_ || scene_.observation().frame < 0;
    if (ended_) return;
    scene_.Restart(RandomId());
    shown_us_ = 0;
    return;
  }
  Publish();
  const std::int64_t now_us = scene_.observation().sim_time_us;
  const std::chrono::duration<double, std::micro> passed(static_cast<double>(now_us - shown_us_) /
                                                         speed_);
  shown_us_ = now_us;
  due_ = std::max(due_ + std::chrono::duration_cast<Clock::duration>(passed), Clock::now());
}

void Player::Publish() {
  observation_t observation = scene_.observation();
  observation.utime = UtimeNow();
  if (scene_.label()) {
    label_t label = *scene_.label();
    label.utime = observation.utime;
    bus_.Publish(label);
  }
  bus_.Publish(observation);
  repeat_due_.Due(SteadyMs());
}

int Player::TimeoutMs() const {
  if (paused_ || ended_) return kLongestWaitMs;
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(due_ - Clock::now()).count();
  return static_cast<int>(std::clamp<long long>(left, 0, kLongestWaitMs));
}

void Player::Turn() {
  bus_.Poll(TimeoutMs());
  if (!paused_ && !ended_ && Clock::now() >= due_) ShowNext();
  const std::int64_t now_ms = SteadyMs();
  if (hold_.Lapsed(now_ms)) hold_.Free();
  if (task_due_.Due(now_ms)) {
    task_t task = scene_.task();
    task.utime = UtimeNow();
    bus_.Publish(task);
  }
  if (scene_.observation().frame >= 0 && repeat_due_.Due(now_ms)) Publish();
  health_.SetState(health_t::STATE_READY, ended_ ? "the video has ended" : "");
  health_.Tick();
}

void Player::Leave() {
  health_.SetState(health_t::STATE_DRAINING, "leaving");
  health_.PublishNow();
}

}  // namespace prospect::services
