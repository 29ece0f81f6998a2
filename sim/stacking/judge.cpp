#include "sim/stacking/judge.h"

#include <algorithm>
#include <cmath>

namespace prospect::sim {
namespace {

constexpr double kHeightTolerance = 0.01;  // m, of a block upon another
constexpr double kResting = 0.02;          // m/s
constexpr int kJoints = 6;

std::string JointName(int index) { return "joint " + std::to_string(index + 1); }

const char* PartName(Touches::Part part) {
  switch (part) {
    case Touches::Part::kArm:
      return "arm";
    case Touches::Part::kGripper:
      return "gripper";
    case Touches::Part::kHeldBlock:
      return "held block";
    case Touches::Part::kNone:
      break;
  }
  return "";
}

bool Inside(const Eigen::Vector3d& point, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return (point.array() >= low.array()).all() && (point.array() <= high.array()).all();
}

Eigen::Vector3d Where(const TabletopWorld& world, int block) {
  return world.loose().body(block).frame().translation();
}

}  // namespace

const char* ToString(StackingOutcome outcome) {
  switch (outcome) {
    case StackingOutcome::kRunning:
      return "running";
    case StackingOutcome::kSuccess:
      return "success";
    case StackingOutcome::kObstacle:
      return "obstacle";
    case StackingOutcome::kTime:
      return "time";
    case StackingOutcome::kWorkspace:
      return "workspace";
    case StackingOutcome::kUnreachable:
      return "unreachable";
    case StackingOutcome::kBlockLost:
      return "block_lost";
    case StackingOutcome::kPlanExhausted:
      return "plan_exhausted";
  }
  return "unknown";
}

std::string StackingVerdict::Reason() const {
  if (outcome == StackingOutcome::kRunning || outcome == StackingOutcome::kSuccess) return "";
  const std::string name = ToString(outcome);
  return detail.empty() ? name : name + "(" + detail + ")";
}

std::vector<CauseSpec> StackingCauses() {
  std::vector<CauseSpec> causes;
  const auto add = [&causes](StackingOutcome outcome, const std::string& detail,
                             const std::string& words) {
    causes.push_back({StackingVerdict{outcome, detail}.Reason(), words});
  };
  add(StackingOutcome::kTime, "", "it ran out of time");
  for (const auto part :
       {Touches::Part::kArm, Touches::Part::kGripper, Touches::Part::kHeldBlock}) {
    const std::string name = PartName(part);
    add(StackingOutcome::kObstacle, name, "its " + name + " touched the obstacle");
  }
  add(StackingOutcome::kWorkspace, "table", "it hit the table");
  add(StackingOutcome::kWorkspace, "tool", "it left its workspace");
  for (int i = 0; i < kJoints; ++i)
    add(StackingOutcome::kWorkspace, JointName(i), "its " + JointName(i) + " left its range");
  add(StackingOutcome::kUnreachable, "", "it could not reach there");
  add(StackingOutcome::kBlockLost, "", "a block fell off the table");
  add(StackingOutcome::kPlanExhausted, "", "no tower stood at the end of the plan");
  return causes;
}

bool JointsSlow(const ArmChain& arm, double limit) {
  const JointVector speeds = arm.joint_speeds();
  return std::all_of(speeds.begin(), speeds.end(),
                     [limit](double speed) { return std::abs(speed) <= limit; });
}

StackingVerdict StackingJudge::AfterStep(const TabletopWorld& world) const {
  const Touches& touches = world.touches();
  if (touches.obstacle != Touches::Part::kNone) {
    return {StackingOutcome::kObstacle, PartName(touches.obstacle)};
  }
  if (touches.table != Touches::Part::kNone) return {StackingOutcome::kWorkspace, "table"};
  return {};
}

StackingVerdict StackingJudge::AfterTick(const TabletopWorld& world) const {
  const StackingVerdict limits = Limits(world);
  if (limits.outcome != StackingOutcome::kRunning) return limits;
  for (int i = 0; i < world.loose().obstacle(); ++i) {
    if (!Inside(Where(world, i), p_.table_low, p_.table_high)) {
      return {StackingOutcome::kBlockLost, ""};
    }
  }
  if (IsHome(world) && TowerHeight(world) >= tower_) return {StackingOutcome::kSuccess, ""};
  return {};
}

StackingVerdict StackingJudge::Limits(const TabletopWorld& world) const {
  const JointVector joints = world.arm().joints();
  for (int i = 0; i < kJoints; ++i) {
    if (std::abs(joints[i]) > joint_limit_[i]) return {StackingOutcome::kWorkspace, JointName(i)};
  }
  if (!Inside(world.arm().tool().translation(), p_.workspace_low, p_.workspace_high)) {
    return {StackingOutcome::kWorkspace, "tool"};
  }
  return {};
}

bool StackingJudge::IsHome(const TabletopWorld& world) const {
  const double away = (world.arm().tool().translation() - p_.home).norm();
  return away <= p_.home_tolerance && JointsSlow(world.arm(), p_.still);
}

int StackingJudge::TowerHeight(const TabletopWorld& world) const {
  int highest = 1;
  for (int i = 0; i < world.loose().obstacle(); ++i) {
    highest = std::max(highest, HeightAbove(world, i));
  }
  return highest;
}

// Ends, because every block above lies higher than the one below.
int StackingJudge::HeightAbove(const TabletopWorld& world, int base) const {
  int above = 0;
  for (int i = 0; i < world.loose().obstacle(); ++i) {
    if (i != base && RestsOn(world, i, base)) above = std::max(above, HeightAbove(world, i));
  }
  return 1 + above;
}

bool StackingJudge::RestsOn(const TabletopWorld& world, int upper, int lower) const {
  const LooseBodies& loose = world.loose();
  const Eigen::Vector3d offset = Where(world, upper) - Where(world, lower);
  return std::abs(offset.z() - p_.block_height) < kHeightTolerance &&
         offset.head<2>().norm() <= p_.stacked_within && loose.speed(upper) < kResting &&
         loose.speed(lower) < kResting && !world.touches().by_robot[upper] &&
         !world.touches().by_robot[lower] && world.touches().stacked[upper * loose.size() + lower];
}

}  // namespace prospect::sim
