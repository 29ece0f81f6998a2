#pragma once

#include <Eigen/Geometry>

namespace prospect::sim {

// Progress of a minimum-jerk movement (Flash and Hogan 1985) at `share` of its time, both 0 to 1.
double MinimumJerk(double share);

// The way of one hand during a phase of a gesture: either a free movement, along a cubic Bezier
// curve whose inner points are off the straight line, while it turns the shortest way; or a turn
// about a fixed axis, as when a needle is driven along its own circle. Plain data.
struct HandMove {
  Eigen::Isometry3d from = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d to = Eigen::Isometry3d::Identity();
  Eigen::Vector3d early_bend = Eigen::Vector3d::Zero();  // m off the line, a third along
  Eigen::Vector3d late_bend = Eigen::Vector3d::Zero();   // two thirds along

  bool circular = false;  // then `to` is ignored
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double angle = 0;

  double opening = 0;  // of the jaws, as wanted

  // Where the hand should be at `share` (0 to 1) of the phase's time.
  Eigen::Isometry3d At(double share) const;
};

}  // namespace prospect::sim
