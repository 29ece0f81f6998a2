#include "sim/tabletop/arm_chain.h"

#include <algorithm>
#include <cmath>

namespace prospect::sim {
namespace {

constexpr double kFollowForce = 200.0;  // N, of the linkage that makes the second finger follow
constexpr double kFollowGain = 0.5;     // share of the difference made good in one step

}  // namespace

ArmChain::ArmChain(OdeWorld* world, const ArmDescription& arm, const GripperDescription& gripper)
    : world_(world), arm_(arm), gripper_(gripper), kinematics_(arm.lengths) {
  for (int i = 0; i < 6; ++i) {
    std::vector<const BodyDescription*> parts = {&arm_.links[i]};
    if (i == 5) parts.push_back(&gripper_.palm);
    links_[i] = std::make_unique<RigidBody>(world, parts);
  }
  for (auto& finger : fingers_) {
    finger =
        std::make_unique<RigidBody>(world, std::vector<const BodyDescription*>{&gripper_.finger});
  }
  // Hinges count their angle from where the bodies stand when the axis is set.
  Place({}, 0);
  MakeHinges();
  MakeSlides();
  DriveJoints({});
  DriveGripper(0, gripper_.force);
}

ArmChain::~ArmChain() {
  for (dJointID hinge : hinges_) dJointDestroy(hinge);
  for (dJointID slide : slides_) dJointDestroy(slide);
}

// Joint i turns link i about the z axis of frame i - 1. ODE counts the first body against the
// second.
void ArmChain::MakeHinges() {
  Eigen::Isometry3d before = arm_.base;
  for (int i = 0; i < 6; ++i) {
    hinges_[i] = dJointCreateHinge(world_->id(), nullptr);
    dJointAttach(hinges_[i], links_[i]->id(), i > 0 ? links_[i - 1]->id() : nullptr);
    const Eigen::Vector3d at = before.translation();
    const Eigen::Vector3d axis = before.linear().col(2);
    dJointSetHingeAnchor(hinges_[i], at.x(), at.y(), at.z());
    dJointSetHingeAxis(hinges_[i], axis.x(), axis.y(), axis.z());
    dJointSetHingeParam(hinges_[i], dParamFMax, arm_.torque_limit[i]);
    before = links_[i]->frame();
  }
}

void ArmChain::MakeSlides() {
  for (int i = 0; i < 2; ++i) {
    slides_[i] = dJointCreateSlider(world_->id(), nullptr);
    dJointAttach(slides_[i], fingers_[i]->id(), links_[5]->id());
    const Eigen::Vector3d axis = fingers_[i]->frame().linear().col(1);
    dJointSetSliderAxis(slides_[i], axis.x(), axis.y(), axis.z());
    dJointSetSliderParam(slides_[i], dParamFMax, kFollowForce);
  }
}

Eigen::Isometry3d ArmChain::FingerFrame(const Eigen::Isometry3d& tool, int finger,
                                        double out) const {
  Eigen::Isometry3d side = Eigen::Isometry3d::Identity();
  if (finger == 1) side.linear() = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  return tool * side * Eigen::Translation3d(0, out, 0);
}

void ArmChain::Place(const JointVector& q, double opening) {
  const std::array<Eigen::Isometry3d, 6> frames = kinematics_.Frames(q);
  for (int i = 0; i < 6; ++i) links_[i]->Place(arm_.base * frames[i]);
  const Eigen::Isometry3d at = tool();
  for (int i = 0; i < 2; ++i) fingers_[i]->Place(FingerFrame(at, i, opening / 2));
  wanted_opening_ = opening;
}

void ArmChain::DriveJoints(const JointVector& speeds) {
  for (int i = 0; i < 6; ++i) {
    const double limit = arm_.speed_limit[i];
    dJointSetHingeParam(hinges_[i], dParamVel, std::clamp(speeds[i], -limit, limit));
  }
}

void ArmChain::DriveGripper(double opening, double force) {
  wanted_opening_ = std::clamp(opening, 0.0, gripper_.opening);
  dJointSetSliderParam(slides_[0], dParamFMax, std::clamp(force, 0.0, gripper_.force));
}

void ArmChain::UpdateGripper(double dt) {
  const double out = FingerOut(0);
  const double most = gripper_.speed;
  const double lead = std::clamp((wanted_opening_ / 2 - out) / dt * 0.2, -most, most);
  const double follow = std::clamp(kFollowGain * (out - FingerOut(1)) / dt, -2 * most, 2 * most);
  dJointSetSliderParam(slides_[0], dParamVel, lead);
  dJointSetSliderParam(slides_[1], dParamVel, follow);
}

double ArmChain::FingerOut(int finger) const {
  const Eigen::Vector3d offset = fingers_[finger]->frame().translation() - tool().translation();
  const double across = links_[5]->frame().linear().col(1).dot(offset);
  return finger == 0 ? across : -across;
}

JointVector ArmChain::joints() const {
  JointVector q;
  for (int i = 0; i < 6; ++i) q[i] = dJointGetHingeAngle(hinges_[i]);
  return q;
}

JointVector ArmChain::joint_speeds() const {
  JointVector speeds;
  for (int i = 0; i < 6; ++i) speeds[i] = dJointGetHingeAngleRate(hinges_[i]);
  return speeds;
}

double ArmChain::opening() const { return FingerOut(0) + FingerOut(1); }

Eigen::Isometry3d ArmChain::tool() const {
  return flange() * Eigen::Translation3d(0, 0, gripper_.grasp_depth);
}

}  // namespace prospect::sim
