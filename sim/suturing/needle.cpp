#include "sim/suturing/needle.h"

#include <algorithm>
#include <cmath>

namespace prospect::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d Columns(const Vector3d& x, const Vector3d& y, const Vector3d& z) {
  Matrix3d turn;
  turn << x, y, z;
  return turn;
}

// The direction that is "up" in the plane in which the needle is driven.
Vector3d DriveUp(const SuturingParameters& p) {
  return {0, std::sin(p.plane_tilt), std::cos(p.plane_tilt)};
}

}  // namespace

Vector3d NeedlePoint(const SuturingParameters& p, double angle) {
  return p.needle_radius * Vector3d(std::cos(angle), std::sin(angle), 0);
}

Isometry3d GripAt(const SuturingParameters& p, double angle) {
  const Vector3d radial(std::cos(angle), std::sin(angle), 0);
  const Vector3d tool = -Vector3d::UnitZ();
  Isometry3d grip = Isometry3d::Identity();
  grip.linear() = Columns(radial, tool.cross(radial), tool);
  grip.translation() = NeedlePoint(p, angle);
  return grip;
}

Vector3d EntryDot(const SuturingParameters& p, int i) {
  return {p.half_bite, p.first_throw - i * p.throw_gap, 0};
}

Vector3d ExitDot(const SuturingParameters& p, int i) {
  return {-p.half_bite, p.first_throw - i * p.throw_gap, 0};
}

Isometry3d DrivePose(const SuturingParameters& p, int i, double angle) {
  const Vector3d up = DriveUp(p);
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = Columns(Vector3d::UnitX(), up, Vector3d::UnitX().cross(up));
  const double above = std::sqrt(p.needle_radius * p.needle_radius - p.half_bite * p.half_bite);
  const Vector3d middle = (EntryDot(p, i) + ExitDot(p, i)) / 2;
  pose.translation() = middle + above * up;
  pose.rotate(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
  return pose;
}

double EntryAngle(const SuturingParameters& p) { return -std::acos(p.half_bite / p.needle_radius); }

double ExitAngle(const SuturingParameters& p) { return -M_PI - EntryAngle(p); }

double DistanceToWire(const SuturingParameters& p, const Isometry3d& needle,
                      const Vector3d& point) {
  const Vector3d local = needle.inverse() * point;
  double angle = std::atan2(local.y(), local.x());
  if (angle < 0) angle = local.x() > 0 ? 0 : M_PI;  // beyond one of its ends
  return (local - NeedlePoint(p, angle)).norm();
}

}  // namespace prospect::sim
