#pragma once

#include <Eigen/Geometry>

#include "base/random.h"
#include "sim/stacking/action_table.h"
#include "sim/stacking/parameters.h"
#include "sim/tabletop/tabletop_world.h"

namespace prospect::sim {

// What the execution of one pick and place makes of the commands. Each part is drawn when an action
// begins that it concerns, and holds until it is drawn again.
struct StackingNoise {
  Eigen::Vector3d grip = Eigen::Vector3d::Zero();   // m, where it grips (drawn by align)
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // m, where it stacks (drawn by align_over)
  double speed = 1;                                 // factor (drawn by every action)
  double release_delay = 0;                         // s (drawn by open)
  double early_release =
      -1;  // s into this action at which the gripper opens by mistake; < 0: never
};

// The non-optimal expert that carries an action out, as costar_plan's controllers do: the tool goes
// straight to its target, whatever stands in the way. Every control period it takes the tool's
// pose, moves it a little towards the target, and sends the joints where inverse kinematics says.
// The target follows its block, apart from that of kStack, which is where the block was when the
// action began.
//
// Plain data between calls: copying it saves it. `world`, `parameters` and `scene` are those of the
// task it belongs to.
class StackingController {
 public:
  // Holds still where the arm is, the gripper open (opening: at most).
  void Rest(const TabletopWorld& world, double opening);

  // Begins `action`, with noise drawn from `random`.
  void Begin(const TabletopWorld& world, const StackingParameters& p, const StackingAction& action,
             base::Random random);

  // Gives the action up: the arm brakes and holds still.
  void Stop(const TabletopWorld& world);

  // Sets the motors for the next control period. False if the tool cannot go where it should.
  bool Control(TabletopWorld* world, const StackingParameters& p, const GripperDescription& gripper,
               const ArmDescription& arm);

  // Whether the running action's end condition is met.
  bool Done(const TabletopWorld& world, const StackingParameters& p) const;

 private:
  void DrawNoise(const StackingParameters& p, base::Random random);
  bool Moves() const;
  bool AtHomePoint() const;
  Eigen::Isometry3d Target(const TabletopWorld& world, const StackingParameters& p) const;
  Eigen::Isometry3d NextPose(const Eigen::Isometry3d& tool, const Eigen::Isometry3d& target,
                             const StackingParameters& p);
  bool MoveJoints(TabletopWorld* world, const StackingParameters& p,
                  const GripperDescription& gripper, const ArmDescription& arm);
  void HoldJoints(TabletopWorld* world) const;

  bool running_ = false;
  StackingAction action_ = {StackingKind::kAlign, 0};
  StackingNoise noise_;
  double elapsed_ = 0;  // s since the action began
  double speed_ = 0;    // m/s of the tool, for its ramp
  double opening_ = 0;  // the gripper's, as commanded
  JointVector hold_ = {};
  Eigen::Isometry3d frozen_ = Eigen::Isometry3d::Identity();  // kStack's target
};

}  // namespace prospect::sim
