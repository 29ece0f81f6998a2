#pragma once

#include <Eigen/Geometry>

#include "sim/suturing/parameters.h"

namespace prospect::sim {

// The needle's geometry. Its frame: the arc's centre is the origin, the arc lies in the x-y plane,
// the point `angle` behind the tip is at radius * (cos(angle), sin(angle), 0), the tail (where the
// thread begins) at angle pi.
Eigen::Vector3d NeedlePoint(const SuturingParameters& p, double angle);

// A hand's frame in the needle's frame when it grips the wire at `angle`: z points from the wrist
// to the jaws' tips and is perpendicular to the needle's plane, x is the direction in which the
// jaws open and is radial. Jaws are symmetric, so turning it half about z gives the same grip.
Eigen::Isometry3d GripAt(const SuturingParameters& p, double angle);

// Stitch `i`, 0..throws-1: the dot where the needle enters and the one where it leaves.
Eigen::Vector3d EntryDot(const SuturingParameters& p, int i);
Eigen::Vector3d ExitDot(const SuturingParameters& p, int i);

// The needle on the circle through both dots of stitch `i`, its tip at `angle` on the circle
// (0: right of the centre, pi / 2: above it). Driving it lets the angle fall.
Eigen::Isometry3d DrivePose(const SuturingParameters& p, int i, double angle);

// Angles of the dots on that circle.
double EntryAngle(const SuturingParameters& p);
double ExitAngle(const SuturingParameters& p);

// Distance of `point` (world) from the needle's wire at `needle`.
double DistanceToWire(const SuturingParameters& p, const Eigen::Isometry3d& needle,
                      const Eigen::Vector3d& point);

}  // namespace prospect::sim
