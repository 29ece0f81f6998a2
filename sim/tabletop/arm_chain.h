#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <vector>

#include "sim/tabletop/rigid_body.h"

namespace prospect::sim {

// The arm and its gripper in ODE: six links on hinges, two fingers on slides, each joint with a
// motor that keeps a speed as long as its torque or force allows. Motors carry the arm's weight;
// nothing is welded to the gripper, a block is held by what friction the fingers' force gives.
//
// The second finger's motor follows the first finger's opening, as the real gripper's linkage does;
// so the pair as a whole holds its place while the first one's force presses.
class ArmChain {
 public:
  ArmChain(OdeWorld* world, const ArmDescription& arm, const GripperDescription& gripper);
  ~ArmChain();
  ArmChain(const ArmChain&) = delete;
  ArmChain& operator=(const ArmChain&) = delete;

  // Stands at rest at joints `q` with the pads `opening` apart.
  void Place(const JointVector& q, double opening);

  // Motor speeds (rad/s), cut off at the limits, until the next call.
  void DriveJoints(const JointVector& speeds);

  // Towards this opening between the pads, with `force` (N) at most, until the next call.
  void DriveGripper(double opening, double force);

  // Sets the fingers' motors for the next step of `dt` seconds.
  void UpdateGripper(double dt);

  JointVector joints() const;        // rad, in (-pi, pi]
  JointVector joint_speeds() const;  // rad/s
  double opening() const;            // between the pads (m)

  Eigen::Isometry3d flange() const { return links_[5]->frame(); }

  // The grasp frame: between the pads, z away from the arm.
  Eigen::Isometry3d tool() const;

  // Bodies in a fixed order: links 1 to 6 (the palm with the last), then the fingers.
  static constexpr int kBodies = 8;
  const RigidBody& body(int i) const { return i < 6 ? *links_[i] : *fingers_[i - 6]; }
  static bool IsFinger(int i) { return i >= 6; }

 private:
  void MakeHinges();
  void MakeSlides();
  Eigen::Isometry3d FingerFrame(const Eigen::Isometry3d& tool, int finger, double out) const;
  double FingerOut(int finger) const;

  OdeWorld* world_;
  ArmDescription arm_;
  GripperDescription gripper_;
  UrKinematics kinematics_;
  std::array<std::unique_ptr<RigidBody>, 6> links_;
  std::array<std::unique_ptr<RigidBody>, 2> fingers_;
  std::array<dJointID, 6> hinges_;
  std::array<dJointID, 2> slides_;
  double wanted_opening_ = 0;
};

}  // namespace prospect::sim
