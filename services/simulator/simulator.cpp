#include "services/simulator/simulator.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "services/common/ids.h"

namespace prospect::services {
namespace {

constexpr int kQuickRepeats = 3;
constexpr int kLongestWaitMs = 40;

std::int8_t StateCode(sim::ActionState state) {
  switch (state) {
    case sim::ActionState::kIdle:
      return action_status_t::STATE_IDLE;
    case sim::ActionState::kRunning:
      return action_status_t::STATE_RUNNING;
    case sim::ActionState::kSucceeded:
      return action_status_t::STATE_SUCCEEDED;
    case sim::ActionState::kFailed:
      return action_status_t::STATE_FAILED;
    case sim::ActionState::kCancelled:
      return action_status_t::STATE_CANCELLED;
  }
  return action_status_t::STATE_UNKNOWN;
}

double TickSeconds(const SimulatorOptions& options, const task_t& task) {
  return options.real_time ? task.tick_seconds : 1 / options.frames_per_second;
}

}  // namespace

Simulator::Simulator(Bus& bus, const SimulatorOptions& options)
    : bus_(bus),
      options_(options),
      health_(bus, "simulator"),
      monitor_(bus),
      scene_(options.task, options.scene, RandomId(), options.seed) {
  tick_period_ = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(TickSeconds(options_, scene_.task())));
  status_.action = -1;
  FollowTask();
  subscriptions_.push_back(
      bus_.Subscribe<health_t>([this](const health_t& health) { hold_.Hear(health, SteadyMs()); }));
  subscriptions_.push_back(bus_.Subscribe<sim_command_t>(
      [this](const sim_command_t& command) { OnSimCommand(command); }));
  subscriptions_.push_back(bus_.Subscribe<action_command_t>(
      [this](const action_command_t& command) { OnActionCommand(command); }));
  health_.SetState(health_t::STATE_READY);
}

void Simulator::OnSimCommand(const sim_command_t& command) {
  if (!sim_commands_.Take(command.sender_id, command.command_id)) return;
  const std::string busy = hold_.BusyFor(command.sender_id);
  if (!busy.empty()) {
    spdlog::warn("command of {} refused: {}", command.sender_id, busy);
    bus_.CountRefused(ChannelOf<sim_command_t>(), "busy");
    return PublishStatus();  // which says who holds it
  }
  if (command.present_episode_id != scene_.episode_id()) {
    spdlog::warn("command of {} refused: meant for episode {}, here is {}", command.sender_id,
                 command.present_episode_id, scene_.episode_id());
    bus_.CountRefused(ChannelOf<sim_command_t>(), "another episode");
    return PublishStatus();  // which says what is here
  }
  if (command.kind == sim_command_t::KIND_RESET) return Reset(command);
  hold_.Take(command.sender_id, SteadyMs());
  paused_ = command.kind == sim_command_t::KIND_PAUSE;
  if (!paused_) next_tick_ = Clock::now();
}

void Simulator::Reset(const sim_command_t& command) {
  try {
    scene_.Reset(command.episode_id, static_cast<std::uint64_t>(command.seed), command.objects,
                 command.legs);
  } catch (const std::invalid_argument& error) {
    spdlog::warn("reset refused: {}", error.what());
    bus_.CountRefused(ChannelOf<sim_command_t>(), "scene parameters");
    health_.SetState(health_t::STATE_READY, std::string("reset refused: ") + error.what());
    return;
  }
  spdlog::info("scene {}: {} actions to a plan", command.seed, scene_.task().plan_length);
  hold_.Take(command.sender_id, SteadyMs());
  paused_ = false;
  status_ = action_status_t{};
  status_.action = -1;
  FollowTask();
  PublishTask();
  PublishFrame();
  PublishStatus();
}

void Simulator::OnActionCommand(const action_command_t& command) {
  const bool latest =
      command.executive_id == status_.executive_id && command.command_id == status_.command_id;
  if (latest) return PublishStatus();
  if (!action_commands_.Take(command.executive_id, command.command_id)) return;
  const std::string busy = hold_.BusyFor(command.executive_id);
  if (!busy.empty()) return Answer(command, busy);
  if (command.episode_id != scene_.episode_id()) {
    return Answer(command, "meant for episode " + std::to_string(command.episode_id) +
                               ", here is " + std::to_string(scene_.episode_id()));
  }
  if (command.kind == action_command_t::KIND_START) Start(command);
  if (command.kind == action_command_t::KIND_CANCEL) Cancel(command);
}

void Simulator::Start(const action_command_t& command) {
  const std::string refusal = scene_.Start(command.action);
  if (!refusal.empty()) return Answer(command, refusal);
  spdlog::info("action {} begins", command.action);
  hold_.Take(command.executive_id, SteadyMs());
  next_tick_ = Clock::now();
  Answer(command, "");
}

void Simulator::Cancel(const action_command_t& command) {
  const std::int32_t action = status_.action;
  CancelRunning("cancelled by its executive");
  Answer(command, "");
  status_.action = action;
}

// A refusal while an action runs, or while another executive holds the robot, is told once and does
// not replace the status that the holder waits for.
void Simulator::Answer(const action_command_t& command, const std::string& refusal) {
  const action_status_t before = status_;
  status_.executive_id = command.executive_id;
  status_.command_id = command.command_id;
  status_.action = command.kind == action_command_t::KIND_START ? command.action : status_.action;
  FollowTask();
  if (!refusal.empty()) {
    spdlog::warn("command {} refused: {}", command.command_id, refusal);
    status_.state = action_status_t::STATE_REFUSED;
    status_.reason = refusal;
  }
  PublishStatus();
  const bool apart = scene_.running() || !hold_.BusyFor(command.executive_id).empty();
  if (!refusal.empty() && apart) status_ = before;
}

void Simulator::FollowTask() {
  const auto progress = scene_.progress();
  status_.sim_time_us = scene_.observation().sim_time_us;
  status_.episode_id = scene_.episode_id();
  status_.frame = scene_.frame();
  status_.state = StateCode(progress.action_state);
  status_.outcome = OutcomeCode(progress.outcome);
  status_.reason = progress.reason;
}

void Simulator::CancelRunning(const std::string& reason) {
  if (!scene_.running()) return;
  spdlog::info("action {} stops: {}", status_.action, reason);
  scene_.Cancel();
  FollowTask();
  PublishStatus();
}

void Simulator::TickIfDue() {
  if (!Ticking() || Clock::now() < next_tick_) return;
  next_tick_ = std::max(next_tick_ + tick_period_, Clock::now() - tick_period_);
  const bool was_running = scene_.running();
  scene_.Tick();
  PublishFrame();
  if (!was_running) return;
  FollowTask();
  if (scene_.running()) return;
  spdlog::info("action {} ended: state {} {}", status_.action, status_.state, status_.reason);
  PublishStatus();
}

void Simulator::WatchHolder() {
  if (!hold_.Lapsed(SteadyMs())) return;
  CancelRunning("its executive left or fell silent");
  hold_.Free();
  PublishStatus();
}

void Simulator::PublishFrame() {
  observation_t observation = scene_.observation();
  label_t label = scene_.label();
  observation.utime = label.utime = UtimeNow();
  bus_.Publish(label);
  bus_.Publish(observation);
  quick_repeats_left_ = kQuickRepeats;
  quick_repeat_due_.Due(SteadyMs());
  repeat_due_.Due(SteadyMs());
}

void Simulator::PublishStatus() {
  status_.utime = UtimeNow();
  status_.holder_id = hold_.holder();
  bus_.Publish(status_);
}

void Simulator::PublishTask() {
  task_t task = scene_.task();
  task.utime = UtimeNow();
  bus_.Publish(task);
}

void Simulator::PublishPeriodic() {
  const std::int64_t now_ms = SteadyMs();
  if (task_due_.Due(now_ms)) PublishTask();
  if (status_due_.Due(now_ms)) PublishStatus();
  if (Ticking()) return;
  const int quick_left = quick_repeats_left_;
  const bool quick = quick_left > 0 && quick_repeat_due_.Due(now_ms);
  if (!quick && !repeat_due_.Due(now_ms)) return;
  PublishFrame();
  quick_repeats_left_ = std::max(0, quick_left - 1);
}

int Simulator::TimeoutMs() const {
  if (!Ticking()) return kLongestWaitMs;
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(next_tick_ - Clock::now()).count();
  return static_cast<int>(std::clamp<long long>(left, 0, kLongestWaitMs));
}

void Simulator::Turn() {
  bus_.Poll(TimeoutMs());
  TickIfDue();
  WatchHolder();
  PublishPeriodic();
  health_.SetState(scene_.running() ? health_t::STATE_BUSY : health_t::STATE_READY);
  health_.Tick();
}

void Simulator::Leave() {
  CancelRunning("the simulator leaves");
  health_.SetState(health_t::STATE_DRAINING, "leaving");
  health_.PublishNow();
}

}  // namespace prospect::services
