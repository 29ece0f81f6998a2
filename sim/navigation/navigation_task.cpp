#include "sim/navigation/navigation_task.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/random.h"
#include "sim/navigation/catalogue.h"

namespace prospect::sim {
namespace {

constexpr std::uint64_t kNoiseStream = 0x657865637574ULL;
constexpr int kRestingSteps = 30;  // after which the wheels carry the weight

TaskSpec MakeSpec(const TaskOptions& options, const NavigationParameters& parameters) {
  TaskSpec spec;
  spec.name = "navigation";
  spec.world_version = NavigationWorldVersion();
  spec.plan_length = options.legs;
  spec.image_width = 64;
  spec.image_height = 64;
  spec.tick_seconds = parameters.tick;
  spec.step_seconds = parameters.step;
  spec.action_time_limit = parameters.time_limit;
  const std::vector<ObjectKind>& kinds = ObjectCatalogue();
  const int count = static_cast<int>(kinds.size());
  for (int i = 0; i < count; ++i) {
    spec.actions.push_back({i, "investigate(" + kinds[i].name + ")", "investigate", kinds[i].name});
  }
  spec.causes = {{"time", "it ran out of time"}, {"left_site", "it left the site"}};
  for (const ObjectKind& kind : kinds) {
    spec.causes.push_back({"collision(" + kind.name + ")", "it ran into the " + kind.name});
    spec.landmarks.push_back(kind.name);
  }
  spec.landmarks.insert(spec.landmarks.end(), {"robot", "robot front"});
  spec.successors.resize(count + 1);
  for (int from = 0; from <= count; ++from) {
    for (int to = 0; to < count; ++to) {
      if (to != from) spec.successors[from].push_back(to);
    }
  }
  return spec;
}

void CheckOptions(const TaskOptions& options) {
  if (options.objects < 4 || options.objects > 7) {
    throw std::invalid_argument("navigation: objects is " + std::to_string(options.objects) +
                                ", give 4 to 7");
  }
  if (options.legs < 3 || options.legs > 5 || options.legs > options.objects) {
    throw std::invalid_argument("navigation: legs is " + std::to_string(options.legs) +
                                ", give 3 to 5 and at most the number of objects");
  }
}

dGeomID MakeGeom(const PlacedObject& object) {
  const ObjectKind& kind = ObjectCatalogue()[object.kind];
  const Footprint& f = kind.footprint;
  const dGeomID geom = f.is_disc() ? dCreateCylinder(nullptr, f.radius, kind.height)
                                   : dCreateBox(nullptr, 2 * f.half_x, 2 * f.half_y, kind.height);
  dGeomSetPosition(geom, object.pose.x, object.pose.y, kind.height / 2);
  dMatrix3 rotation;
  dRFromAxisAndAngle(rotation, 0, 0, 1, object.pose.yaw);
  dGeomSetRotation(geom, rotation);
  return geom;
}

}  // namespace

struct NavigationTask::State : TaskState {
  TaskOptions options;
  NavigationScene scene;
  Trial trial;
  Husky::State robot;
};

NavigationTask::NavigationTask(const TaskOptions& options)
    : parameters_(TheNavigationParameters()), options_(options), robot_(&world_) {
  CheckOptions(options);
  spec_ = MakeSpec(options, parameters_);
  Reset(0);
}

NavigationTask::~NavigationTask() { DestroyObjects(); }

void NavigationTask::Reset(std::uint64_t seed) {
  ResetTo(DrawScene(seed, options_.objects, parameters_), base::MixSeeds({seed, kNoiseStream}));
}

void NavigationTask::ResetTo(const NavigationScene& scene, std::uint64_t noise_seed) {
  scene_ = scene;
  BuildSite();
  trial_ = Trial();
  trial_.noise_seed = noise_seed;
  trial_.visited.assign(spec_.actions.size(), false);
  trial_.progress.action = spec_.null_action();
  trial_.progress.previous_action = spec_.null_action();
  robot_.Place(scene_.start);
  for (int i = 0; i < kRestingSteps; ++i) {
    robot_.Drive({}, parameters_.step);
    world_.Step(parameters_.step);
  }
}

void NavigationTask::BuildSite() {
  OdeWorld::PrepareThread();
  DestroyObjects();
  for (const PlacedObject& object : scene_.objects) object_geoms_.push_back(MakeGeom(object));
  camera_.reset();
}

void NavigationTask::DestroyObjects() {
  for (dGeomID geom : object_geoms_) dGeomDestroy(geom);
  object_geoms_.clear();
}

void NavigationTask::BuildCamera() {
  VisualBody still;
  for (const PlacedObject& object : scene_.objects) {
    const Pose2& pose = object.pose;
    for (const VisualPart& part :
         Placed(ObjectCatalogue()[object.kind].visual, pose.x, pose.y, pose.yaw)) {
      still.push_back(part);
      still.back().color = TurnedHue(part.color, options_.shift.hue);
    }
  }
  const double half = parameters_.half_view;
  const auto ground = [half](double x, double y) { return GroundColorAt(x, y, half); };
  const double tilt = options_.shift.camera * M_PI / 180;
  camera_ = std::make_unique<AerialCamera>(AerialView{parameters_.camera_height, half, tilt},
                                           ground, still, std::vector<VisualBody>{Husky::Visual()});
}

bool NavigationTask::StartAction(int action) {
  const std::vector<int> legal = LegalActions();
  if (running() || std::find(legal.begin(), legal.end(), action) == legal.end()) return false;
  Progress& progress = trial_.progress;
  progress.previous_action = progress.action;
  progress.action = action;
  progress.action_state = ActionState::kRunning;
  ++progress.segment;
  trial_.history = base::MixSeeds({trial_.history, static_cast<std::uint64_t>(action) + 1});
  trial_.leg_start = trial_.steps;
  trial_.arrived = -1;
  const LegNoise noise =
      DrawLegNoise(parameters_, base::Random(base::MixSeeds({trial_.noise_seed, trial_.history})));
  const Pose2& target = Find(action)->pose;
  trial_.controller.Begin(target.x, target.y, noise);
  return true;
}

void NavigationTask::Cancel() {
  if (running()) trial_.progress.action_state = ActionState::kCancelled;
}

void NavigationTask::Tick() {
  OdeWorld::PrepareThread();
  const int steps = static_cast<int>(std::lround(parameters_.tick / parameters_.step));
  for (int i = 0; i < steps; ++i) {
    ++trial_.steps;
    if (trial_.progress.outcome == Outcome::kRunning) Step();
  }
  trial_.progress.time = static_cast<double>(trial_.steps) * parameters_.step;
}

void NavigationTask::Step() {
  robot_.Drive(Command(), parameters_.step);
  world_.Step(parameters_.step);
  Judge();
}

// Without a running leg, and while it settles, the robot brakes and then holds still.
Twist2 NavigationTask::Command() {
  if (!running() || trial_.arrived >= 0) return {};
  return trial_.controller.Update(parameters_, robot_.pose(), TargetGap(), parameters_.step);
}

void NavigationTask::Judge() {
  const int touched = TouchedObject();
  if (touched >= 0) {
    Fail("collision(" + spec_.actions[touched].object + ")");
  } else if (LeftSite()) {
    Fail("left_site");
  } else if (running()) {
    JudgeLeg();
  }
}

void NavigationTask::JudgeLeg() {
  const double elapsed = static_cast<double>(trial_.steps - trial_.leg_start) * parameters_.step;
  if (trial_.arrived >= 0) {
    if (Settled()) FinishLeg();
  } else if (trial_.controller.driving() && TargetGap() <= parameters_.reach) {
    trial_.arrived = trial_.steps;
  } else if (elapsed > parameters_.time_limit) {
    Fail("time");
  }
}

bool NavigationTask::Settled() const {
  const Twist2 velocity = robot_.velocity();
  const bool still = std::abs(velocity.forward) < 0.02 && std::abs(velocity.turn) < 0.03;
  const double since = static_cast<double>(trial_.steps - trial_.arrived) * parameters_.step;
  return still || since >= parameters_.settle_time;
}

void NavigationTask::FinishLeg() {
  Progress& progress = trial_.progress;
  progress.action_state = ActionState::kSucceeded;
  trial_.visited[progress.action] = true;
  if (++progress.actions_done == spec_.plan_length) progress.outcome = Outcome::kSuccess;
}

void NavigationTask::Fail(const std::string& reason) {
  if (running()) trial_.progress.action_state = ActionState::kFailed;
  trial_.progress.outcome = Outcome::kFailure;
  trial_.progress.reason = reason;
}

// ODE is asked only where the circles about hull and object meet: nearly never, so that it costs
// nothing.
int NavigationTask::TouchedObject() const {
  static const double hull_radius = Husky::Hull().bounding_radius();
  const Pose2 pose = robot_.pose();
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    const PlacedObject& object = scene_.objects[i];
    const double reach = hull_radius + ObjectCatalogue()[object.kind].footprint.bounding_radius();
    if (std::hypot(object.pose.x - pose.x, object.pose.y - pose.y) > reach) continue;
    if (robot_.Touches(object_geoms_[i])) return object.kind;
  }
  return -1;
}

bool NavigationTask::LeftSite() const {
  static const Footprint hull = Husky::Hull();
  const Pose2 pose = robot_.pose();
  if (std::max(std::abs(pose.x), std::abs(pose.y)) + hull.bounding_radius() <
      parameters_.half_view) {
    return false;
  }
  for (const Eigen::Vector2d& corner : hull.Corners(pose)) {
    if (corner.cwiseAbs().maxCoeff() > parameters_.half_view) return true;
  }
  return false;
}

const PlacedObject* NavigationTask::Find(int action) const {
  for (const PlacedObject& object : scene_.objects) {
    if (object.kind == action) return &object;
  }
  return nullptr;
}

double NavigationTask::TargetGap() const {
  return DistanceToHull(*Find(trial_.progress.action), robot_.pose());
}

Image NavigationTask::Observe() { return Render(spec_.image_width, spec_.image_height); }

Image NavigationTask::Render(int width, int height) {
  if (camera_ == nullptr) BuildCamera();
  const double light = scene_.light * options_.shift.light;
  return camera_->Render({robot_.ChassisPose()}, light, width, height);
}

int NavigationTask::CountRobotPixels(int width, int height) {
  if (camera_ == nullptr) BuildCamera();
  return camera_->CountMovingPixels({robot_.ChassisPose()}, width, height);
}

Progress NavigationTask::progress() const { return trial_.progress; }

std::vector<double> NavigationTask::RobotState() const {
  const Pose2 pose = robot_.pose();
  const Twist2 velocity = robot_.velocity();
  return {pose.x, pose.y, pose.yaw, velocity.forward, velocity.turn};
}

// The picture's upper edge is the site's far y, its centre the site's.
std::vector<Landmark> NavigationTask::Landmarks() const {
  const double size = 2 * parameters_.half_view;
  const auto seen = [size](double x, double y) { return Landmark{0.5 + x / size, 0.5 - y / size}; };
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  std::vector<Landmark> landmarks(spec_.landmarks.size(), {kNowhere, kNowhere});
  for (const PlacedObject& object : scene_.objects) {
    landmarks[object.kind] = seen(object.pose.x, object.pose.y);
  }
  const Pose2 pose = robot_.pose();
  const double reach = Husky::Hull().half_x;
  const std::size_t robot = ObjectCatalogue().size();
  landmarks[robot] = seen(pose.x, pose.y);
  landmarks[robot + 1] =
      seen(pose.x + reach * std::cos(pose.yaw), pose.y + reach * std::sin(pose.yaw));
  return landmarks;
}

std::unique_ptr<TaskState> NavigationTask::Save() const {
  auto state = std::make_unique<State>();
  state->options = options_;
  state->scene = scene_;
  state->trial = trial_;
  state->robot = robot_.Save();
  return state;
}

void NavigationTask::Restore(const TaskState& state) {
  const auto* saved = dynamic_cast<const State*>(&state);
  if (saved == nullptr || saved->options.objects != options_.objects ||
      saved->options.legs != options_.legs) {
    throw std::invalid_argument(
        "this state was saved by another task or with other options: restore it into a task made "
        "with the same name, objects and legs");
  }
  if (!(saved->scene == scene_)) {
    scene_ = saved->scene;
    BuildSite();
  }
  trial_ = saved->trial;
  robot_.Restore(saved->robot);
}

void NavigationTask::SetNoiseSeed(std::uint64_t noise_seed) { trial_.noise_seed = noise_seed; }

std::vector<int> NavigationTask::LegalActions() const {
  std::vector<int> legal;
  if (trial_.progress.outcome != Outcome::kRunning) return legal;
  for (const PlacedObject& object : scene_.objects) {
    if (!trial_.visited[object.kind]) legal.push_back(object.kind);
  }
  return legal;
}

std::vector<std::string> NavigationTask::Facts() const {
  std::vector<std::string> facts;
  for (const ActionSpec& action : spec_.actions) {
    if (trial_.visited[action.index]) facts.push_back("visited(" + action.object + ")");
  }
  return facts;
}

std::vector<bool> NavigationTask::PresentActions() const {
  std::vector<bool> present(spec_.actions.size(), false);
  for (const PlacedObject& object : scene_.objects) present[object.kind] = true;
  return present;
}

}  // namespace prospect::sim
