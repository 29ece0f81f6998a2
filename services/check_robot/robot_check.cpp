#include "services/check_robot/robot_check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "base/hash.h"
#include "base/number_format.h"
#include "lcmtypes/validate.h"
#include "services/common/clock.h"
#include "services/common/ids.h"
#include "services/common/robot_hold.h"
#include "services/common/signals.h"
#include "tasks/picture_size.h"

namespace prospect::services {
namespace {

constexpr double kNoticeSeconds = 3;

// What is wrong with an action table; empty: nothing.
std::string TableDefect(const task_t& task) {
  std::set<std::string> names;
  for (int i = 0; i < task.num_actions; ++i) {
    const action_t& action = task.actions[static_cast<std::size_t>(i)];
    if (action.index != i) return "row " + std::to_string(i) + " has another index";
    if (action.name.empty() || !names.insert(action.name).second) {
      return "row " + std::to_string(i) + " has no name of its own";
    }
    for (const int next : action.successors) {
      if (next < 0 || next >= task.num_actions) return action.name + " has an unknown successor";
    }
  }
  if (task.initial.empty()) return "no action may come first";
  return "";
}

}  // namespace

RobotCheck::RobotCheck(Bus& bus, const tasks::TaskFile* file)
    : bus_(bus), file_(file), monitor_(bus), health_(bus, "executive") {
  subscriptions_.push_back(bus_.Subscribe<task_t>([this](const task_t& task) { task_ = task; }));
  subscriptions_.push_back(bus_.Subscribe<observation_t>([this](observation_t picture) {
    looks_.push_back(base::HashBytes(picture.data.data(), picture.data.size()));
    delays_.push_back(1e-6 * static_cast<double>(UtimeNow() - picture.utime));
    picture.data.clear();
    episode_id_ = picture.episode_id;
    pictures_.push_back(std::move(picture));
  }));
  subscriptions_.push_back(bus_.Subscribe<action_status_t>([this](const action_status_t& status) {
    status_ = status;
    if (status.state == action_status_t::STATE_REFUSED)
      refusals_[status.executive_id] = status.reason;
    status_ms_.push_back(SteadyMs());
  }));
}

bool RobotCheck::Until(const Condition& condition, double seconds, const Condition& repeat) {
  const std::int64_t end_ms = SteadyMs() + static_cast<std::int64_t>(1000 * seconds);
  std::int64_t repeat_ms = 0;
  while (!condition()) {
    if (StopRequested()) throw ExitError(kExitInterrupted, "interrupted");
    if (SteadyMs() >= end_ms) return false;
    if (repeat && SteadyMs() >= repeat_ms) {
      repeat();
      repeat_ms = SteadyMs() + 50;
    }
    if (!silent_) health_.Tick();
    bus_.Poll(10);
  }
  return true;
}

void RobotCheck::Note(const std::string& rule, bool kept, const std::string& detail) {
  using Verdict = RobotFinding::Verdict;
  findings_.push_back({rule, kept ? Verdict::kOk : Verdict::kFault, detail});
}

void RobotCheck::NotTried(const std::string& rule, const std::string& why) {
  findings_.push_back({rule, RobotFinding::Verdict::kNotTried, why});
}

std::vector<RobotFinding> RobotCheck::Run() {
  findings_.clear();
  health_.SetState(health_t::STATE_READY);
  CheckTask();
  if (!task_) return findings_;
  CheckAgreement();
  RequireFree();
  CheckStillness();
  CheckRefusals();
  CheckAction();
  CheckPictures();
  CheckHold();
  CheckCancel();
  CheckSilence();
  if (file_ != nullptr) CheckOutcomes();
  health_.SetState(health_t::STATE_DRAINING);
  health_.PublishNow();  // so that the robot is free at once
  return findings_;
}

void RobotCheck::Tell(const std::string& about, const std::string& words) {
  findings_.push_back({about, RobotFinding::Verdict::kNote, words});
}

// A holder that died holds for 3 s more.
void RobotCheck::RequireFree() {
  Until([&] { return status_.has_value(); }, 1.5);
  const bool free = Until([&] { return !status_ || HeldBy(0); }, 4);
  if (!free) throw ExitError(kExitServiceLost, BusyText(status_->holder_id));
}

void RobotCheck::CheckTask() {
  const bool heard = Until([&] { return task_.has_value(); }, kNoticeSeconds);
  Note("TASK is published at least every 3 s", heard);
  const bool alive = Until([&] { return !monitor_.Alive("simulator").empty(); }, kNoticeSeconds);
  Note("HEALTH says that a \"simulator\" lives", alive);
  if (!heard) return;
  const std::string defect = TableDefect(*task_);
  Note("the action table is whole", defect.empty(),
       defect.empty() ? std::to_string(task_->num_actions) + " actions" : defect);
  Note("plan_length, tick_seconds and action_time_limit are positive",
       task_->plan_length > 0 && task_->tick_seconds > 0 && task_->action_time_limit > 0);
  const std::string size = tasks::PictureSizeRemark(task_->image_width, task_->image_height);
  if (!size.empty()) Tell("size of pictures", size);
}

// What a robot says while it holds still: the same picture again, and how it stands.
void RobotCheck::CheckStillness() {
  pictures_.clear();
  status_ms_.clear();
  const std::int64_t start_ms = SteadyMs();
  Until([&] { return SteadyMs() - start_ms > 3200; }, 4);
  Note("OBSERVATION is repeated at least every 1.5 s while nothing moves", pictures_.size() >= 2,
       std::to_string(pictures_.size()) + " pictures in 3.2 s");
  std::int64_t gap_ms = SteadyMs() - start_ms;
  for (std::size_t i = 1; i < status_ms_.size(); ++i) {
    gap_ms = std::max(i == 1 ? 0 : gap_ms, status_ms_[i] - status_ms_[i - 1]);
  }
  Note("ACTION_STATUS comes at 2 Hz", status_ms_.size() >= 2 && gap_ms <= 800,
       "longest gap " + base::Fixed(static_cast<double>(gap_ms) / 1000, 2) + " s");
  if (pictures_.empty()) return;
  const observation_t& picture = pictures_.back();
  Note("pictures are of the size that TASK says",
       picture.width == task_->image_width && picture.height == task_->image_height,
       std::to_string(picture.width) + "x" + std::to_string(picture.height));
  const bool same = std::all_of(pictures_.begin(), pictures_.end(),
                                [&](const observation_t& o) { return o.frame == picture.frame; });
  Note("a repeated picture keeps its frame number", same);
}

action_command_t RobotCheck::Command(std::int8_t kind, int action) {
  action_command_t command{};
  command.executive_id = health_.instance_id();
  command.command_id = ++last_id_;
  command.episode_id = episode_id_;
  command.kind = kind;
  command.action = action;
  return command;
}

bool RobotCheck::Named(std::int64_t command_id) const {
  return status_ && status_->executive_id == health_.instance_id() &&
         status_->command_id == command_id;
}

bool RobotCheck::Running() const {
  return status_ && status_->state == action_status_t::STATE_RUNNING;
}

// Repeats the command until a status names it, as an executive does.
bool RobotCheck::Send(const action_command_t& command) {
  return Until([&] { return Named(command.command_id); }, kNoticeSeconds,
               [&] {
                 action_command_t now = command;
                 now.utime = UtimeNow();
                 return bus_.Publish(now);
               });
}

void RobotCheck::CheckRefusals() {
  const auto refused = [&](const action_command_t& command) {
    return Send(command) && status_->state == action_status_t::STATE_REFUSED &&
           !status_->reason.empty();
  };
  const std::string unknown = "an action that is not in the table is refused, with a reason";
  if (task_->num_actions < messages::kMaxActions)
    Note(unknown, refused(Command(action_command_t::KIND_START, task_->num_actions)));
  else  // the bus carries no command that names another
    NotTried(unknown, "the table is the largest there may be");
  action_command_t elsewhere = Command(action_command_t::KIND_START, task_->initial.front());
  elsewhere.episode_id += 1;
  Note("a command for another episode is refused, with a reason", refused(elsewhere));
}

// Starts the first action that is not refused.
bool RobotCheck::StartAny() {
  for (const int action : task_->initial) {
    if (!Send(Command(action_command_t::KIND_START, action))) return false;
    if (status_->state == action_status_t::STATE_REFUSED) continue;
    willing_ = action;
    return true;
  }
  return false;
}

// A simulator may be asked for a scene in which actions are possible again; a robot ignores it.
void RobotCheck::NewScene() {
  const std::int64_t before = episode_id_;
  sim_command_t reset{};
  reset.sender_id = health_.instance_id();
  reset.command_id = ++last_scene_;
  reset.kind = sim_command_t::KIND_RESET;
  reset.present_episode_id = before;
  reset.seed = last_scene_;
  reset.episode_id = RandomId();
  const bool new_scene = Until([&] { return episode_id_ != before; }, 1.5,
                               [&] {
                                 reset.utime = UtimeNow();
                                 return bus_.Publish(reset);
                               });
  if (new_scene) willing_ = -1;
}

// Starts actions until one still runs after a moment.
bool RobotCheck::StartLasting() {
  std::vector<int> order;
  if (willing_ >= 0) order = task_->actions[static_cast<std::size_t>(willing_)].successors;
  order.insert(order.end(), task_->initial.begin(), task_->initial.end());
  for (const int action : order) {
    if (!Send(Command(action_command_t::KIND_START, action))) return false;
    if (status_->state == action_status_t::STATE_REFUSED) continue;
    if (Until([&] { return !Running(); }, 0.4)) continue;
    willing_ = action;
    return true;
  }
  return false;
}

void RobotCheck::CheckAction() {
  bool started = StartAny();
  if (!started) {  // an episode may have ended here
    NewScene();
    started = StartAny();
  }
  Note("a START that fits is taken within 3 s", started,
       started || !status_ ? "" : status_->reason);
  if (!started) return;
  pictures_.clear();
  looks_.clear();
  delays_.clear();
  const std::int64_t id = last_id_;
  if (Running()) {
    action_command_t second = Command(action_command_t::KIND_START, willing_);
    second.utime = UtimeNow();
    bus_.Publish(second);
  }
  const double patience = 4 * task_->action_time_limit + 2;  // a simulator's clock may run slowly
  bool replaced = false;
  const bool ended = Until(
      [&] {
        replaced = replaced || (!Named(id) && Running());
        return Named(id) && !Running();  // the refusal of the second names that
      },
      patience);
  Note("a second START while an action runs does not replace it", !replaced);
  double took = 0;  // by the pictures' clock
  if (!pictures_.empty()) {
    took = static_cast<double>(pictures_.back().sim_time_us - pictures_.front().sim_time_us) / 1e6;
  }
  Note(
      "an action ends within action_time_limit", ended && took <= task_->action_time_limit + 1,
      task_->actions[static_cast<std::size_t>(willing_)].name + ", " + base::Fixed(took, 2) + " s");
  bool in_order = true, paced = true;
  for (std::size_t i = 1; i < pictures_.size(); ++i) {
    const auto step = pictures_[i].frame - pictures_[i - 1].frame;
    if (step < 0 || step > 1) in_order = false;
    const double seconds =
        static_cast<double>(pictures_[i].sim_time_us - pictures_[i - 1].sim_time_us) / 1e6;
    if (step == 1 && std::abs(seconds / task_->tick_seconds - 1) > 0.5) paced = false;
  }
  if (pictures_.size() < 3) {
    return NotTried("pictures of an action come one a tick", "the action was over at once");
  }
  Note("frame numbers grow one by one", in_order, std::to_string(pictures_.size()) + " pictures");
  Note("pictures of an action come one a tick", paced,
       "a tick is " + base::Fixed(task_->tick_seconds, 2) + " s");
}

// Whether a START of another executive is refused, with a reason.
bool RobotCheck::RefusesAnother() {
  action_command_t command = Command(action_command_t::KIND_START, std::max(0, willing_));
  command.executive_id = RandomId();
  command.command_id = 0;
  return Until([&] { return !refusals_[command.executive_id].empty(); }, kNoticeSeconds,
               [&] {
                 command.utime = UtimeNow();
                 ++command.command_id;  // a refusal is told once
                 return bus_.Publish(command);
               });
}

void RobotCheck::CheckHold() {
  const char* holder = "ACTION_STATUS says which executive holds the robot";
  const char* others = "a START of another executive is refused meanwhile, with a reason";
  const char* leaving = "the robot is free again when its executive says that it leaves";
  if (willing_ < 0) {
    for (const char* rule : {holder, others, leaving}) NotTried(rule, "no action could be started");
    return;
  }
  Note(holder, Until([&] { return HeldBy(health_.instance_id()); }, 1));
  Note(others, RefusesAnother());
  health_.SetState(health_t::STATE_DRAINING);
  const bool freed = Until([&] { return HeldBy(0); }, 2,
                           [&] {
                             health_.PublishNow();
                             return true;
                           });
  Note(leaving, freed);
  health_.SetState(health_t::STATE_READY);
}

void RobotCheck::CheckCancel() {
  const char* rule = "CANCEL stops the robot within 1 s";
  NewScene();
  if (!StartLasting()) return NotTried(rule, "no action could be started that lasts");
  const bool sent = Send(Command(action_command_t::KIND_CANCEL, -1));
  const bool stopped = Until([&] { return !Running(); }, 1);
  Note(rule, sent && stopped);
}

// An action may be over before three seconds of silence are, so several are tried.
void RobotCheck::CheckSilence() {
  constexpr int kAttempts = 5;
  const char* rule = "the robot stops within 5 s when its executive falls silent";
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    NewScene();
    if (!StartLasting()) continue;
    silent_ = true;
    const std::int64_t start_ms = SteadyMs();
    const bool stopped = Until([&] { return !Running(); }, 5);
    const double seconds = static_cast<double>(SteadyMs() - start_ms) / 1000;
    silent_ = false;
    if (stopped && status_->state != action_status_t::STATE_CANCELLED) continue;
    return Note(rule, stopped, "after " + base::Fixed(seconds, 2) + " s");
  }
  NotTried(rule, "no action lasts so long");
}

}  // namespace prospect::services
