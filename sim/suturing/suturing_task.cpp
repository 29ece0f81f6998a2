#include "sim/suturing/suturing_task.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/random.h"
#include "sim/suturing/gestures.h"
#include "sim/suturing/needle.h"

namespace prospect::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::uint64_t kNoiseStream = 0x7375747572656eULL;
constexpr double kEyes = 5e-3;  // m between a stereo endoscope's lenses
constexpr int kSettleSteps = 60;

void CheckOptions(const TaskOptions& options) {
  const Shift& shift = options.shift;
  if (shift.light != 1 || shift.camera != 0 || shift.hue != 0) {
    throw std::invalid_argument("suturing: its pictures have no shifts");
  }
  if (options.surgeon < -1 || options.surgeon >= kSurgeons) {
    throw std::invalid_argument("suturing: surgeon is " + std::to_string(options.surgeon) +
                                ", give 0 to 7, or -1 for any");
  }
  const int rate = options.frames_per_second;
  if (rate < 1 || rate > 30 || 30 % rate != 0) {
    throw std::invalid_argument("suturing: " + std::to_string(rate) +
                                " frames a second, give 1, 2, 3, 5, 6, 10, 15 or 30");
  }
}

// Execution noise scales deviations and the chances of mistakes.
SuturingParameters ScaledParameters(const TaskOptions& options) {
  if (!(options.execution_noise >= 0 && options.execution_noise <= 10)) {
    throw std::invalid_argument("suturing: execution_noise is out of range, give 0 to 10");
  }
  SuturingParameters p = TheSuturingParameters();
  for (double* noise : {&p.wander, &p.end_noise, &p.turn_noise, &p.bite_noise, &p.grip_noise,
                        &p.slip, &p.bad_bite, &p.bad_grip}) {
    *noise *= options.execution_noise;
  }
  return p;
}

TaskSpec MakeSpec(const TaskOptions& options, const SuturingParameters& p) {
  TaskSpec spec;
  spec.name = "suturing";
  spec.world_version = SuturingWorldVersion();
  if (options.execution_noise != 1) {
    spec.world_version += "-noise" + std::to_string(options.execution_noise);
  }
  spec.actions = SuturingActions();
  spec.successors = SuturingSuccessors();
  spec.repeats_allowed = true;
  spec.causes = {{"time", "it ran out of time"},
                 {"dropped(needle)", "it dropped the needle"},
                 {"missed(entry)", "the needle went in beside its dot"}};
  spec.landmarks = {"right hand", "left hand", "needle tip", "needle tail"};
  spec.plan_length = 2 + 4 * p.throws;  // G1, G5, then G2, G3, G6, G4 a throw, the last with G11
  spec.image_width = 128;
  spec.image_height = 96;
  spec.tick_seconds = 1.0 / options.frames_per_second;
  spec.step_seconds = p.step;
  spec.action_time_limit = p.gesture_limit;
  return spec;
}

}  // namespace

struct SuturingTask::State : TaskState {
  std::string world_version;
  TaskOptions options;
  SuturingScene scene;
  Trial trial;
  SuturingWorld::State world;
};

SuturingTask::SuturingTask(const TaskOptions& options)
    : options_(options), p_(ScaledParameters(options)), world_(p_) {
  CheckOptions(options);
  spec_ = MakeSpec(options, p_);
  steps_per_tick_ = static_cast<int>(std::lround(spec_.tick_seconds / p_.step));
  Reset(0);
}

void SuturingTask::Reset(std::uint64_t seed) {
  OdeWorld::PrepareThread();
  scene_ = DrawSuturingScene(seed, options_.surgeon, p_);
  endoscope_.reset();
  world_.Place(scene_.hands, scene_.needle);
  trial_ = Trial();
  trial_.noise_seed = base::MixSeeds({seed, kNoiseStream});
  trial_.last_done = spec_.null_action();
  trial_.progress.action = spec_.null_action();
  trial_.progress.previous_action = spec_.null_action();
  SuturingThread& thread = trial_.suture.thread;
  thread.end = scene_.thread_end;
  thread.length = scene_.thread_length;
  thread.side = scene_.thread_side;
  trial_.player.Rest(world_);
  for (int i = 0; i < kSettleSteps; ++i) {
    trial_.player.Control(&world_, &trial_.suture, p_, scene_.style);
    world_.Step();
  }
}

bool SuturingTask::StartAction(int action) {
  const std::vector<int> legal = LegalActions();
  if (running() || std::find(legal.begin(), legal.end(), action) == legal.end()) return false;
  Progress& progress = trial_.progress;
  progress.previous_action = progress.action;
  progress.action = action;
  progress.action_state = ActionState::kRunning;
  ++progress.segment;
  trial_.history = base::MixSeeds({trial_.history, static_cast<std::uint64_t>(action) + 1});
  trial_.player.Begin(action, base::MixSeeds({trial_.noise_seed, trial_.history}), world_,
                      &trial_.suture, p_, scene_.style);
  return true;
}

void SuturingTask::Cancel() {
  if (!running()) return;
  trial_.progress.action_state = ActionState::kCancelled;
  trial_.player.Stop(world_);
}

void SuturingTask::Tick() {
  OdeWorld::PrepareThread();
  for (int i = 0; i < steps_per_tick_; ++i) {
    ++trial_.steps;
    if (trial_.progress.outcome == Outcome::kRunning) StepOnce();
  }
  trial_.progress.time = static_cast<double>(trial_.steps) * p_.step;
  const bool late = trial_.progress.time > p_.trial_limit;
  if (late && trial_.progress.outcome == Outcome::kRunning) End(false, "time");
}

void SuturingTask::StepOnce() {
  const bool goes_on = trial_.player.Control(&world_, &trial_.suture, p_, scene_.style);
  world_.Step();
  if (!running() || goes_on) return;
  if (!trial_.player.failure().empty()) return End(false, trial_.player.failure());
  FinishGesture();
}

void SuturingTask::FinishGesture() {
  Progress& progress = trial_.progress;
  progress.action_state = ActionState::kSucceeded;
  ++progress.actions_done;
  trial_.last_done = progress.action;
  if (progress.action != kDrop) return;
  End(AllThrown(), AllThrown() ? "" : "incomplete");
}

void SuturingTask::End(bool success, const std::string& reason) {
  Progress& progress = trial_.progress;
  if (running()) progress.action_state = ActionState::kFailed;
  progress.outcome = success ? Outcome::kSuccess : Outcome::kFailure;
  progress.reason = reason;
}

// Beyond the table of successors: after the last throw the needle is not handed over again.
std::vector<int> SuturingTask::LegalActions() const {
  if (trial_.progress.outcome != Outcome::kRunning) return {};
  std::vector<int> legal = spec_.successors[trial_.last_done];
  if (AllThrown()) {
    legal.erase(std::remove(legal.begin(), legal.end(), static_cast<int>(kTransfer)), legal.end());
  }
  return legal;
}

std::vector<bool> SuturingTask::PresentActions() const {
  std::vector<bool> present(spec_.actions.size(), false);
  for (const std::vector<int>& row : spec_.successors) {
    for (int action : row) present[action] = true;
  }
  return present;
}

std::vector<std::string> SuturingTask::Facts() const {
  std::vector<std::string> facts;
  if (world_.holder() == kRightHand) facts.push_back("held(needle,right)");
  if (world_.holder() == kLeftHand) facts.push_back("held(needle,left)");
  facts.push_back("throws(" + std::to_string(trial_.suture.throws()) + ")");
  return facts;
}

Endoscope& SuturingTask::endoscope() {
  if (endoscope_ == nullptr) endoscope_ = std::make_unique<Endoscope>(p_, scene_.look);
  return *endoscope_;
}

Image SuturingTask::Observe() { return Render(spec_.image_width, spec_.image_height); }

Image SuturingTask::Render(int width, int height) { return RenderFrom(0, width, height); }

Image SuturingTask::RenderRightEye(int width, int height) {
  return RenderFrom(kEyes, width, height);
}

Image SuturingTask::RenderFrom(double sideways, int width, int height) {
  std::vector<Isometry3d> poses;
  for (int i = 0; i < 2; ++i) AppendInstrument(p_, i, world_.hand(i), world_.opening(i), &poses);
  poses.push_back(world_.needle());
  const std::vector<Strand> thread =
      ThreadStrands(trial_.suture.thread, world_.needle() * NeedlePoint(p_, M_PI),
                    world_.hand(kRightHand).translation());
  return endoscope().Render(poses, thread, scene_.light, sideways, width, height);
}

std::vector<Landmark> SuturingTask::Landmarks() const {
  std::vector<Landmark> landmarks;
  for (const Vector3d& point : {Vector3d(world_.hand(kRightHand).translation()),
                                Vector3d(world_.hand(kLeftHand).translation()),
                                Vector3d(world_.needle() * NeedlePoint(p_, 0)),
                                Vector3d(world_.needle() * NeedlePoint(p_, M_PI))}) {
    const Eigen::Vector2d at = SeenAt(scene_.look, point, spec_.image_width, spec_.image_height);
    landmarks.push_back({at.x(), at.y()});
  }
  return landmarks;
}

std::vector<double> SuturingTask::RobotState() const {
  std::vector<double> state;
  for (int i = 0; i < 2; ++i) {
    const Isometry3d hand = world_.hand(i);
    const Vector3d at = hand.translation();
    const Eigen::Quaterniond turn(hand.linear());
    state.insert(state.end(), {at.x(), at.y(), at.z(), turn.w(), turn.x(), turn.y(), turn.z(),
                               world_.opening(i)});
  }
  return state;
}

std::unique_ptr<TaskState> SuturingTask::Save() const {
  auto state = std::make_unique<State>();
  state->world_version = spec_.world_version;
  state->options = options_;
  state->scene = scene_;
  state->trial = trial_;
  state->world = world_.Save();
  return state;
}

void SuturingTask::Restore(const TaskState& state) {
  const auto* saved = dynamic_cast<const State*>(&state);
  if (saved == nullptr || saved->world_version != spec_.world_version ||
      saved->options.surgeon != options_.surgeon ||
      saved->options.frames_per_second != options_.frames_per_second) {
    throw std::invalid_argument(
        "this state was saved by another task or with other options: restore it into a task made "
        "with the same name, surgeon and frames a second");
  }
  OdeWorld::PrepareThread();
  if (saved->scene.seed != scene_.seed) endoscope_.reset();
  scene_ = saved->scene;
  trial_ = saved->trial;
  world_.Restore(saved->world);
}

}  // namespace prospect::sim
