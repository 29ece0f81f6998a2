#include "sim/stacking/controller.h"

#include <algorithm>
#include <cmath>

#include "sim/stacking/judge.h"

namespace prospect::sim {
namespace {

constexpr double kWideOpen = 1.0;    // m; cut off at what the gripper can
constexpr double kHoldGain = 10.0;   // 1/s
constexpr double kArriveGain = 8.0;  // 1/s, so that the last millimetres are slow
constexpr double kCreep = 0.01;      // m/s, so that braking never ends short of the target
constexpr double kCarryTime = 1.5;   // s of a carrying action in which the gripper may slip

// A cube looks the same after a quarter turn: its frame here is upright and turned by less than an
// eighth.
Eigen::Isometry3d UprightFrame(const Eigen::Isometry3d& block) {
  int best = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(block.linear()(0, axis)) > std::abs(block.linear()(0, best))) best = axis;
  }
  Eigen::Vector3d along = block.linear().col(best);
  if (along.x() < 0) along = -along;
  const double yaw = std::atan2(along.y(), along.x());
  return Eigen::Translation3d(block.translation()) *
         Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
}

Eigen::Vector3d Scatter(double sigma, base::Random* random) {
  Eigen::Vector3d offset;
  for (int i = 0; i < 3; ++i) offset[i] = sigma * random->BoundedNormal();
  return offset;
}

}  // namespace

void StackingController::Rest(const TabletopWorld& world, double opening) {
  *this = StackingController();
  hold_ = world.arm().joints();
  opening_ = opening;
}

void StackingController::Begin(const TabletopWorld& world, const StackingParameters& p,
                               const StackingAction& action, base::Random random) {
  running_ = true;
  action_ = action;
  elapsed_ = 0;
  speed_ = 0;
  hold_ = world.arm().joints();
  DrawNoise(p, random);
  if (action.kind == StackingKind::kAlign) opening_ = kWideOpen;
  if (action.kind == StackingKind::kClose) opening_ = 0;
  if (action.kind == StackingKind::kStack) frozen_ = Target(world, p);
}

void StackingController::DrawNoise(const StackingParameters& p, base::Random random) {
  noise_.speed = 1 + p.speed_noise * random.BoundedNormal();
  noise_.early_release = -1;
  const bool carries =
      action_.kind == StackingKind::kLift || action_.kind == StackingKind::kAlignOver;
  // Two actions carry, so each has half the chance.
  if (carries && random.Uniform() < p.early_release / 2) {
    noise_.early_release = random.Uniform(0, kCarryTime);
  }
  if (action_.kind == StackingKind::kAlign) noise_.grip = Scatter(p.grip_noise, &random);
  if (action_.kind == StackingKind::kAlignOver) noise_.place = Scatter(p.place_noise, &random);
  if (action_.kind == StackingKind::kOpen) {
    noise_.release_delay = p.release_delay * random.Uniform();
  }
}

void StackingController::Stop(const TabletopWorld& world) {
  running_ = false;
  hold_ = world.arm().joints();
}

bool StackingController::Moves() const {
  return action_.kind != StackingKind::kClose && action_.kind != StackingKind::kOpen;
}

bool StackingController::AtHomePoint() const {
  return action_.kind == StackingKind::kLift || action_.kind == StackingKind::kHome;
}

Eigen::Isometry3d StackingController::Target(const TabletopWorld& world,
                                             const StackingParameters& p) const {
  Eigen::Isometry3d target = Eigen::Isometry3d::Identity();
  if (AtHomePoint()) {
    target.translation() = p.home;
    target.linear() = p.approach;
    return target;
  }
  const Eigen::Isometry3d block = UprightFrame(world.loose().body(action_.block).frame());
  Eigen::Vector3d offset = p.align_offset + noise_.grip;
  if (action_.kind == StackingKind::kGrasp) offset = p.grasp_offset + noise_.grip;
  if (action_.kind == StackingKind::kAlignOver) offset = p.over_offset + noise_.place;
  if (action_.kind == StackingKind::kStack) offset = p.stack_offset + noise_.place;
  if (action_.kind == StackingKind::kBackOff) offset = p.over_offset;
  target.translation() = block * offset;
  target.linear() = block.linear() * p.approach;
  return target;
}

Eigen::Isometry3d StackingController::NextPose(const Eigen::Isometry3d& tool,
                                               const Eigen::Isometry3d& target,
                                               const StackingParameters& p) {
  const Eigen::Vector3d way = target.translation() - tool.translation();
  const double distance = way.norm();
  const double braking = std::sqrt(2 * p.acceleration * distance);
  speed_ = std::min({speed_ + p.acceleration * p.control, p.speed * noise_.speed, braking,
                     kArriveGain * distance + kCreep});
  const double forward = std::min(distance, speed_ * p.control);
  const Eigen::AngleAxisd turn(tool.linear().transpose() * target.linear());
  const double most = std::min(p.turn_speed * p.control, turn.angle() * kArriveGain * p.control);
  Eigen::Isometry3d next = tool;
  if (distance > 0) next.translation() += way * (forward / distance);
  next.linear() = tool.linear() * Eigen::AngleAxisd(most, turn.axis()).toRotationMatrix();
  return next;
}

bool StackingController::MoveJoints(TabletopWorld* world, const StackingParameters& p,
                                    const GripperDescription& gripper, const ArmDescription& arm) {
  const Eigen::Isometry3d tool = world->arm().tool();
  const Eigen::Isometry3d target =
      action_.kind == StackingKind::kStack ? frozen_ : Target(*world, p);
  const Eigen::Isometry3d flange =
      NextPose(tool, target, p) * Eigen::Translation3d(0, 0, -gripper.grasp_depth);
  const JointVector now = world->arm().joints();
  const auto next = UrKinematics(arm.lengths).Nearest(arm.base.inverse() * flange, now);
  if (!next) return false;
  JointVector speeds;
  double most = 1;
  for (int i = 0; i < 6; ++i) {
    speeds[i] = ((*next)[i] - now[i]) / p.control;
    most = std::max(most, std::abs(speeds[i]) / arm.speed_limit[i]);
  }
  for (double& speed : speeds) speed /= most;
  world->arm().DriveJoints(speeds);
  return true;
}

void StackingController::HoldJoints(TabletopWorld* world) const {
  const JointVector now = world->arm().joints();
  JointVector speeds;
  for (int i = 0; i < 6; ++i) {
    speeds[i] = kHoldGain * std::remainder(hold_[i] - now[i], 2 * M_PI);
  }
  world->arm().DriveJoints(speeds);
}

bool StackingController::Control(TabletopWorld* world, const StackingParameters& p,
                                 const GripperDescription& gripper, const ArmDescription& arm) {
  elapsed_ += p.control;
  const bool slips = noise_.early_release >= 0 && elapsed_ > noise_.early_release;
  const bool opens = action_.kind == StackingKind::kOpen && elapsed_ > noise_.release_delay;
  if (running_ && (slips || opens)) opening_ = kWideOpen;
  world->arm().DriveGripper(opening_, gripper.force);
  if (running_ && Moves()) return MoveJoints(world, p, gripper, arm);
  HoldJoints(world);
  return true;
}

// costar_plan's condition: near enough, joints slow, and for targets at a block the tool's turn,
// which does not matter any more once the tool touches it.
bool StackingController::Done(const TabletopWorld& world, const StackingParameters& p) const {
  if (action_.kind == StackingKind::kClose) return elapsed_ >= p.close_time;
  if (action_.kind == StackingKind::kOpen) return elapsed_ >= p.open_time + noise_.release_delay;
  const Eigen::Isometry3d tool = world.arm().tool();
  const Eigen::Isometry3d target =
      action_.kind == StackingKind::kStack ? frozen_ : Target(world, p);
  const double away = (target.translation() - tool.translation()).norm();
  if (away > (AtHomePoint() ? p.home_tolerance : p.tolerance)) return false;
  if (!JointsSlow(world.arm(), p.still)) return false;
  if (AtHomePoint() || world.touches().by_robot[action_.block]) return true;
  const Eigen::Quaterniond a(tool.linear()), b(target.linear());
  return 1 - std::abs(a.dot(b)) <= p.turn_tolerance;
}

}  // namespace prospect::sim
