#pragma once

#include <Eigen/Core>
#include <array>

namespace prospect::sim {

// A pose on flat ground: metres and radians in the site's frame.
struct Pose2 {
  double x = 0;
  double y = 0;
  double yaw = 0;
};

// What a thing covers on the ground: a disc or a rectangle, centred on its pose.
struct Footprint {
  double half_x = 0;  // rectangle: half sizes along its own axes (m); 0 for a disc
  double half_y = 0;
  double radius = 0;  // disc; 0 for a rectangle

  static Footprint Disc(double radius) { return {0, 0, radius}; }
  static Footprint Rectangle(double size_x, double size_y) { return {size_x / 2, size_y / 2, 0}; }

  bool is_disc() const { return radius > 0; }
  double bounding_radius() const;  // of the smallest circle about the centre that holds it (m)

  // The rectangle's corners in the site's frame, counter-clockwise; four times the centre for a
  // disc.
  std::array<Eigen::Vector2d, 4> Corners(const Pose2& pose) const;
};

// Distance between the borders of two footprints (m); 0 if they touch or overlap.
double Distance(const Footprint& a, const Pose2& pose_a, const Footprint& b, const Pose2& pose_b);

// `angle` brought to (-pi, pi].
double WrapAngle(double angle);

}  // namespace prospect::sim
