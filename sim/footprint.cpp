#include "sim/footprint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace prospect::sim {
namespace {

using Corners = std::array<Eigen::Vector2d, 4>;

double PointSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d edge = b - a;
  const double length2 = edge.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * edge).norm();
}

// The least distance from a corner of `a` to an edge of `b`.
double CornersToEdges(const Corners& a, const Corners& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& corner : a) {
    for (int i = 0; i < 4; ++i) least = std::min(least, PointSegment(corner, b[i], b[(i + 1) % 4]));
  }
  return least;
}

// Whether the edge normals of `a` show a line between the two (separating axes).
bool Separates(const Corners& a, const Corners& b) {
  for (int i = 0; i < 2; ++i) {  // opposite edges of a rectangle are parallel
    const Eigen::Vector2d edge = a[i + 1] - a[i];
    if (edge.squaredNorm() == 0) continue;
    const Eigen::Vector2d normal(edge.y(), -edge.x());
    double low_a = 1e300, high_a = -1e300, low_b = 1e300, high_b = -1e300;
    for (int k = 0; k < 4; ++k) {
      low_a = std::min(low_a, normal.dot(a[k]));
      high_a = std::max(high_a, normal.dot(a[k]));
      low_b = std::min(low_b, normal.dot(b[k]));
      high_b = std::max(high_b, normal.dot(b[k]));
    }
    if (high_a < low_b || high_b < low_a) return true;
  }
  return false;
}

}  // namespace

double Footprint::bounding_radius() const {
  return is_disc() ? radius : std::hypot(half_x, half_y);
}

std::array<Eigen::Vector2d, 4> Footprint::Corners(const Pose2& pose) const {
  const Eigen::Vector2d centre(pose.x, pose.y);
  const Eigen::Vector2d along = half_x * Eigen::Vector2d(std::cos(pose.yaw), std::sin(pose.yaw));
  const Eigen::Vector2d across = half_y * Eigen::Vector2d(-std::sin(pose.yaw), std::cos(pose.yaw));
  return {centre + along + across, centre - along + across, centre - along - across,
          centre + along - across};
}

double Distance(const Footprint& a, const Pose2& pose_a, const Footprint& b, const Pose2& pose_b) {
  const Corners corners_a = a.Corners(pose_a);
  const Corners corners_b = b.Corners(pose_b);
  // A disc is its centre grown by its radius, so that one rule serves all pairs.
  const bool apart = (a.is_disc() && b.is_disc()) || Separates(corners_a, corners_b) ||
                     Separates(corners_b, corners_a);
  if (!apart) return 0;
  const double between =
      std::min(CornersToEdges(corners_a, corners_b), CornersToEdges(corners_b, corners_a));
  return std::max(0.0, between - a.radius - b.radius);
}

double WrapAngle(double angle) {
  const double wrapped = std::remainder(angle, 2 * M_PI);
  return wrapped <= -M_PI ? M_PI : wrapped;
}

}  // namespace prospect::sim
