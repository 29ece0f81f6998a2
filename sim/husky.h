#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>

#include "sim/footprint.h"
#include "sim/mesh.h"
#include "sim/ode_world.h"

namespace prospect::sim {

// A wish for how the robot moves: forward speed (m/s) and turning rate (rad/s, counter-clockwise).
struct Twist2 {
  double forward = 0;
  double turn = 0;
};

// Clearpath's Husky A200 on flat ground: a chassis and four wheels on motorised hinges, steered by
// skidding. Masses, sizes and limits are those of Clearpath's published description (body 0.9874 x
// 0.5709 x 0.2475 m, 46.034 kg; wheels of radius 0.1651 m, width 0.1143 m, 2.637 kg; wheelbase
// 0.512 m, track 0.5708 m; 1.0 m/s, 3.0 m/s^2, 2.0 rad/s, 6.0 rad/s^2). A wheel meets the ground in
// one point, with less grip sideways than along its rolling direction.
//
// Threads: one at a time; see OdeWorld. The world must outlive the robot.
class Husky {
 public:
  static constexpr double kWheelRadius = 0.1651;
  static constexpr double kMaxSpeed = 1.0;
  static constexpr double kMaxAcceleration = 3.0;
  static constexpr double kMaxTurnRate = 2.0;
  static constexpr double kMaxTurnAcceleration = 6.0;

  explicit Husky(OdeWorld* world);
  ~Husky();
  Husky(const Husky&) = delete;
  Husky& operator=(const Husky&) = delete;

  // What the robot covers on the ground, wheels included.
  static Footprint Hull();

  // Stands the robot at `pose`, at rest.
  void Place(const Pose2& pose);

  // Brings the wheels towards `command` within the robot's speed and acceleration limits and adds
  // the ground contacts of the coming step of `dt` seconds. Call once before every OdeWorld::Step.
  void Drive(const Twist2& command, double dt);

  Pose2 pose() const;
  Twist2 velocity() const;  // measured at the chassis

  // Whether the hull touches `geom`.
  bool Touches(dGeomID geom) const;

  // The chassis' pose in the site's frame, and what the camera sees of the robot in that frame.
  Eigen::Isometry3d ChassisPose() const;
  static VisualBody Visual();

  struct State {
    std::array<BodyState, 5> bodies;
    Twist2 ramp;
  };
  State Save() const;
  void Restore(const State& state);

 private:
  void MakeChassis();
  void MakeWheel(int i);
  void SetWheelSpeeds();
  void AddContact(int i, const double forward[2]);

  OdeWorld* world_;
  dBodyID chassis_;
  std::array<dBodyID, 4> wheels_;  // front left, front right, rear left, rear right
  std::array<dJointID, 4> hinges_;
  dGeomID hull_;
  Twist2 ramp_;  // the command after the acceleration limits
};

}  // namespace prospect::sim
