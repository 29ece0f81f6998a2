#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

namespace prospect::sim {

// Kinematics of Universal Robots' six-joint arms in closed form.
//
// Frames follow Denavit and Hartenberg: frame i is fixed to link i, and
// T(i-1, i) = Rz(q_i) Tz(d_i) Tx(a_i) Rx(alpha_i) with alpha = (pi/2, 0, 0, pi/2, -pi/2, 0).
// Frame 0 is the base (z up), frame 6 the flange (z points away from the arm). Metres and radians.
//
// Plain data and pure functions: safe from any thread.

using JointVector = std::array<double, 6>;

// The lengths that tell one arm of the family from another; all others are zero.
struct UrLengths {
  double d1 = 0.089159;
  double a2 = -0.425;
  double a3 = -0.39225;
  double d4 = 0.10915;
  double d5 = 0.09465;
  double d6 = 0.0823;
};

// The UR5 of the CB3 series (Universal Robots' published parameters). The UR5e is another arm.
inline constexpr UrLengths kUr5;

class UrKinematics {
 public:
  explicit UrKinematics(const UrLengths& lengths = kUr5) : l_(lengths) {}

  const UrLengths& lengths() const { return l_; }

  // Poses of frames 1 to 6 in frame 0.
  std::array<Eigen::Isometry3d, 6> Frames(const JointVector& q) const;

  // Pose of the flange (frame 6) in frame 0.
  Eigen::Isometry3d Flange(const JointVector& q) const;

  // Every joint vector that brings the flange to `flange`: up to 8 (shoulder left or right, wrist
  // up or down, elbow up or down), joints in (-pi, pi]. Where the wrist is singular (sin q5 = 0)
  // joints 4 and 6 turn about the same axis: joint 6 then keeps `singular_q6` and joint 4 does the
  // rest. Empty if the pose is out of reach. `flange` must be a rotation and a finite translation;
  // anything else gives an empty answer, too.
  std::vector<JointVector> Inverse(const Eigen::Isometry3d& flange, double singular_q6 = 0) const;

  // Of all solutions, also those whole turns away, the one nearest to `reference` (least sum of
  // squared differences) whose joints lie within `limit` radians either side of zero. Nothing if
  // there is none.
  std::optional<JointVector> Nearest(const Eigen::Isometry3d& flange, const JointVector& reference,
                                     double limit = 2 * 3.14159265358979323846) const;

 private:
  void SolveWrist(const Eigen::Isometry3d& flange, double q1, double singular_q6,
                  std::vector<JointVector>* solutions) const;
  void SolveElbow(const Eigen::Isometry3d& flange, double q1, double q5, double q6,
                  std::vector<JointVector>* solutions) const;

  UrLengths l_;
};

}  // namespace prospect::sim
