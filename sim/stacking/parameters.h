#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "sim/arm/ur_kinematics.h"
#include "sim/tabletop/yaml_reader.h"

namespace prospect::sim {

// The stacking task's constants: the section `stacking` of a scene file
// (config/scenes/stacking.yaml explains each). Metres, seconds, radians.
struct StackingParameters {
  // start
  double block_height = 0;
  std::vector<Eigen::Vector2d> block_spots;
  std::vector<Eigen::Vector2d> obstacle_spots;
  double obstacle_gap = 0;  // least distance from the obstacle's centre to a block's
  double jitter = 0;
  double yaw_jitter = 0;
  JointVector start_joints = {};
  double start_jitter = 0;
  double light_range = 0;

  // time
  double tick = 0;
  double control = 0;
  double time_limit = 0;  // of a trial with a tower of two
  int most_actions = 0;

  // what the controllers do
  Eigen::Matrix3d approach;  // the tool's orientation over a block that lies straight
  Eigen::Vector3d align_offset, grasp_offset, over_offset, stack_offset;
  Eigen::Vector3d home;
  double tolerance = 0;
  double home_tolerance = 0;
  double turn_tolerance = 0;
  double still = 0;
  double close_time = 0;
  double open_time = 0;
  double speed = 0;
  double turn_speed = 0;
  double acceleration = 0;

  // execution noise
  double grip_noise = 0;
  double place_noise = 0;
  double speed_noise = 0;
  double release_delay = 0;
  double early_release = 0;

  // verdict
  double stacked_within = 0;
  Eigen::Vector3d workspace_low, workspace_high;
  Eigen::Vector3d table_low, table_high;
};

// Throws SceneFileError naming the entry that is missing, misspelt or out of range, also when there
// are fewer spots than `blocks`.
StackingParameters ReadStackingParameters(const YamlReader& root, int blocks);

}  // namespace prospect::sim
