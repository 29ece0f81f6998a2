#include "sim/stacking/stacking_task.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/random.h"
#include "sim/stacking/action_table.h"
#include "sim/tabletop/scene_file.h"

namespace prospect::sim {
namespace {

// Raised by hand when code changes what a seed gives without changing the scene file.
constexpr int kRevision = 1;
constexpr std::uint64_t kNoiseStream = 0x737461636b6eULL;
constexpr int kSettleSteps = 60;  // after which blocks rest and sleep

// What the camera sees is shifted here, once; physics reads neither cameras nor colours.
void ShiftLooks(const Shift& shift, TabletopDescription* description) {
  for (BodyDescription& block : description->blocks) {
    for (ShapeDescription& shape : block.visual) shape.color = TurnedHue(shape.color, shift.hue);
  }
  const auto observed = description->cameras.find("robot");
  if (shift.camera == 0 || observed == description->cameras.end()) return;
  CameraDescription& camera = observed->second;
  const Eigen::AngleAxisd turn(shift.camera * M_PI / 180, Eigen::Vector3d::UnitZ());
  camera.eye = camera.target + turn * (camera.eye - camera.target);
}

TabletopDescription CheckedDescription(const TaskOptions& options) {
  if (options.tower < 2 || options.tower > 4) {
    throw std::invalid_argument("stacking: tower is " + std::to_string(options.tower) +
                                ", give 2 to 4");
  }
  TabletopDescription description = ReadTabletop(OpenSceneFile(options.scene_file));
  if (static_cast<int>(description.blocks.size()) < options.tower) {
    throw std::invalid_argument("stacking: the scene has fewer blocks than the tower");
  }
  ShiftLooks(options.shift, &description);
  return description;
}

StackingParameters ScaledParameters(const TaskOptions& options, int blocks) {
  if (!(options.execution_noise >= 0 && options.execution_noise <= 10)) {
    throw std::invalid_argument("stacking: execution_noise is out of range, give 0 to 10");
  }
  StackingParameters p = ReadStackingParameters(OpenSceneFile(options.scene_file), blocks);
  for (double* noise :
       {&p.grip_noise, &p.place_noise, &p.speed_noise, &p.release_delay, &p.early_release}) {
    *noise *= options.execution_noise;
  }
  return p;
}

TaskSpec MakeSpec(const TaskOptions& options, const TabletopDescription& description,
                  const StackingParameters& parameters) {
  TaskSpec spec;
  spec.name = "stacking";
  spec.world_version = "stacking-" + SceneHash(OpenSceneFile(options.scene_file), kRevision);
  if (options.execution_noise != 1) {
    spec.world_version += "-noise" + std::to_string(options.execution_noise);
  }
  std::vector<std::string> names;
  for (const BodyDescription& block : description.blocks) names.push_back(block.name);
  const int blocks = static_cast<int>(names.size());
  spec.actions = StackingActions(names);
  spec.successors = StackingSuccessors(blocks);
  spec.repeats_allowed = true;
  spec.causes = StackingCauses();
  spec.landmarks = names;
  spec.landmarks.insert(spec.landmarks.end(), {"obstacle", "gripper"});
  spec.plan_length = kStackingKinds * (options.tower - 1);
  spec.image_width = 64;
  spec.image_height = 64;
  spec.tick_seconds = parameters.tick;
  spec.step_seconds = description.physics.step;
  spec.action_time_limit = parameters.time_limit * (options.tower - 1);
  return spec;
}

double HeightOf(const BodyDescription& body) {
  double height = 0;
  for (const ShapeDescription& shape : body.collision) {
    const double size = shape.kind == ShapeDescription::Kind::kBox
                            ? shape.size.z()
                            : 2 * shape.radius + shape.length;
    height = std::max(height, size);
  }
  return height;
}

}  // namespace

struct StackingTask::State : TaskState {
  std::string world_version;
  int tower = 0;
  StackingScene scene;
  Trial trial;
  TabletopWorld::State world;
};

StackingTask::StackingTask(const TaskOptions& options)
    : options_(options),
      description_(CheckedDescription(options)),
      parameters_(ScaledParameters(options, blocks())),
      spec_(MakeSpec(options, description_, parameters_)),
      obstacle_height_(HeightOf(description_.obstacle)),
      time_limit_(parameters_.time_limit * (options.tower - 1)),
      most_actions_(parameters_.most_actions * (options.tower - 1)),
      world_(description_),
      judge_(parameters_, description_.arm, options.tower) {
  Reset(0);
}

void StackingTask::Reset(std::uint64_t seed) {
  ResetTo(DrawStackingScene(seed, blocks(), obstacle_height_, parameters_),
          base::MixSeeds({seed, kNoiseStream}));
}

void StackingTask::ResetTo(const StackingScene& scene, std::uint64_t noise_seed) {
  OdeWorld::PrepareThread();
  scene_ = scene;
  world_.arm().Place(scene.joints, description_.gripper.opening);
  for (int i = 0; i < blocks(); ++i) world_.loose().Place(i, scene.blocks.at(i));
  world_.loose().Place(world_.loose().obstacle(), scene.obstacle);
  trial_ = Trial();
  trial_.noise_seed = noise_seed;
  trial_.last_done = spec_.null_action();
  trial_.progress.action = spec_.null_action();
  trial_.progress.previous_action = spec_.null_action();
  trial_.controller.Rest(world_, description_.gripper.opening);
  Settle();
}

void StackingTask::Settle() {
  for (int i = 0; i < kSettleSteps; ++i) {
    trial_.controller.Control(&world_, parameters_, description_.gripper, description_.arm);
    world_.Step();
  }
}

bool StackingTask::StartAction(int action) {
  const std::vector<int> legal = LegalActions();
  if (running() || std::find(legal.begin(), legal.end(), action) == legal.end()) return false;
  Progress& progress = trial_.progress;
  progress.previous_action = progress.action;
  progress.action = action;
  progress.action_state = ActionState::kRunning;
  ++progress.segment;
  trial_.history = base::MixSeeds({trial_.history, static_cast<std::uint64_t>(action) + 1});
  trial_.controller.Begin(world_, parameters_, StackingActionAt(action, blocks()),
                          base::Random(base::MixSeeds({trial_.noise_seed, trial_.history})));
  return true;
}

void StackingTask::Cancel() {
  if (!running()) return;
  trial_.progress.action_state = ActionState::kCancelled;
  trial_.controller.Stop(world_);
}

void StackingTask::Tick() {
  OdeWorld::PrepareThread();
  const int periods = static_cast<int>(std::lround(parameters_.tick / parameters_.control));
  const int steps = static_cast<int>(std::lround(parameters_.tick / world_.step()));
  for (int i = 0; i < periods && trial_.progress.outcome == Outcome::kRunning; ++i) {
    if (!ControlPeriod()) break;
  }
  trial_.steps += steps;
  trial_.progress.time = static_cast<double>(trial_.steps) * world_.step();
  if (trial_.progress.outcome == Outcome::kRunning) JudgeTick();
}

// False once the trial is over.
bool StackingTask::ControlPeriod() {
  if (!trial_.controller.Control(&world_, parameters_, description_.gripper, description_.arm)) {
    End({StackingOutcome::kUnreachable, ""});
    return false;
  }
  const int steps = static_cast<int>(std::lround(parameters_.control / world_.step()));
  for (int i = 0; i < steps; ++i) {
    world_.Step();
    const StackingVerdict verdict = judge_.AfterStep(world_);
    if (verdict.outcome == StackingOutcome::kRunning) continue;
    End(verdict);
    return false;
  }
  return true;
}

void StackingTask::JudgeTick() {
  const StackingVerdict verdict = judge_.AfterTick(world_);
  const bool done = running() && trial_.controller.Done(world_, parameters_);
  if (verdict.outcome == StackingOutcome::kSuccess && running()) FinishAction();
  if (verdict.outcome != StackingOutcome::kRunning) return End(verdict);
  if (done) FinishAction();
  if (done && trial_.progress.segment + 1 >= most_actions_) {
    return End({StackingOutcome::kPlanExhausted, ""});
  }
  const bool home = StackingActionAt(trial_.progress.action, blocks()).kind == StackingKind::kHome;
  if (done && home && trial_.progress.segment + 1 >= spec_.plan_length) {
    return End({StackingOutcome::kPlanExhausted, ""});
  }
  if (trial_.progress.time > time_limit_ - 1e-9) End({StackingOutcome::kTime, ""});
}

void StackingTask::FinishAction() {
  trial_.progress.action_state = ActionState::kSucceeded;
  trial_.last_done = trial_.progress.action;
  ++trial_.progress.actions_done;
  trial_.controller.Stop(world_);
}

void StackingTask::End(const StackingVerdict& verdict) {
  Progress& progress = trial_.progress;
  trial_.verdict = verdict;
  const bool success = verdict.outcome == StackingOutcome::kSuccess;
  if (running()) progress.action_state = ActionState::kFailed;
  progress.outcome = success ? Outcome::kSuccess : Outcome::kFailure;
  progress.reason = verdict.Reason();
}

SceneCamera& StackingTask::camera() {
  if (camera_ == nullptr) camera_ = std::make_unique<SceneCamera>(TabletopVisuals(description_));
  return *camera_;
}

std::vector<Eigen::Isometry3d> StackingTask::VisualPoses() const {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < ArmChain::kBodies; ++i) poses.push_back(world_.arm().body(i).frame());
  for (int i = 0; i < world_.loose().size(); ++i) {
    poses.push_back(world_.loose().body(i).frame());
  }
  return poses;
}

Image StackingTask::Observe() { return Render(spec_.image_width, spec_.image_height); }

Image StackingTask::Render(int width, int height) { return RenderFrom("robot", width, height); }

Image StackingTask::RenderFrom(const std::string& name, int width, int height) {
  const auto found = description_.cameras.find(name);
  if (found == description_.cameras.end()) {
    std::string known;
    for (const std::string& one : Cameras()) known += (known.empty() ? "" : ", ") + one;
    throw std::invalid_argument("no camera '" + name + "' in this scene: there are " + known);
  }
  const double light = scene_.light * options_.shift.light;
  return camera().Render(found->second, VisualPoses(), light, width, height);
}

std::vector<std::string> StackingTask::Cameras() const {
  std::vector<std::string> names;
  for (const auto& camera : description_.cameras) names.push_back(camera.first);
  return names;
}

DepthImage StackingTask::ObserveDepth(int width, int height) {
  return camera().RenderDepth(description_.cameras.at("robot"), VisualPoses(), width, height);
}

std::vector<Landmark> StackingTask::Landmarks() const {
  const CameraDescription& view = description_.cameras.at("robot");
  std::vector<Landmark> landmarks;
  const auto see = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector2d at = SeenAt(view, point);
    landmarks.push_back({at.x(), at.y()});
  };
  for (int i = 0; i < world_.loose().size(); ++i) see(world_.loose().body(i).frame().translation());
  see(world_.arm().tool().translation());
  return landmarks;
}

std::vector<double> StackingTask::RobotState() const {
  const JointVector joints = world_.arm().joints();
  const Eigen::Vector3d tool = world_.arm().tool().translation();
  std::vector<double> state(joints.begin(), joints.end());
  state.insert(state.end(), {world_.arm().opening(), tool.x(), tool.y(), tool.z()});
  return state;
}

std::unique_ptr<TaskState> StackingTask::Save() const {
  auto state = std::make_unique<State>();
  state->world_version = spec_.world_version;
  state->tower = options_.tower;
  state->scene = scene_;
  state->trial = trial_;
  state->world = world_.Save();
  return state;
}

void StackingTask::Restore(const TaskState& state) {
  const auto* saved = dynamic_cast<const State*>(&state);
  if (saved == nullptr || saved->world_version != spec_.world_version ||
      saved->tower != options_.tower) {
    throw std::invalid_argument(
        "this state was saved by another task or with other options: restore it into a task made "
        "with the same name, scene file and tower");
  }
  OdeWorld::PrepareThread();
  scene_ = saved->scene;
  trial_ = saved->trial;
  world_.Restore(saved->world);
}

std::vector<int> StackingTask::LegalActions() const {
  if (trial_.progress.outcome != Outcome::kRunning) return {};
  return spec_.successors[trial_.last_done];
}

std::vector<std::string> StackingTask::Facts() const {
  std::vector<std::string> facts;
  const auto name = [&](int block) { return description_.blocks[block].name; };
  for (int upper = 0; upper < blocks(); ++upper) {
    for (int lower = 0; lower < blocks(); ++lower) {
      if (upper != lower && judge_.RestsOn(world_, upper, lower))
        facts.push_back("on(" + name(upper) + "," + name(lower) + ")");
    }
  }
  return facts;
}

std::vector<bool> StackingTask::PresentActions() const {
  return std::vector<bool>(spec_.actions.size(), true);
}

}  // namespace prospect::sim
