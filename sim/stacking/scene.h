#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "sim/arm/ur_kinematics.h"
#include "sim/stacking/parameters.h"

namespace prospect::sim {

// One table: what stands where, how the arm stands, how bright it is.
struct StackingScene {
  std::vector<Eigen::Isometry3d> blocks;
  Eigen::Isometry3d obstacle = Eigen::Isometry3d::Identity();
  JointVector joints = {};
  double light = 1.0;
};

// Draws the scene of `seed`: each block on a spot of its own, the obstacle on one of its spots, all
// with jitter, again until the obstacle stands free. Throws std::runtime_error if the spots leave
// no room for that.
StackingScene DrawStackingScene(std::uint64_t seed, int blocks, double obstacle_height,
                                const StackingParameters& parameters);

}  // namespace prospect::sim
