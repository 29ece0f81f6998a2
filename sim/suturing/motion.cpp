#include "sim/suturing/motion.h"

#include <algorithm>

namespace prospect::sim {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

double MinimumJerk(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * t * (10 + t * (6 * t - 15));
}

Isometry3d HandMove::At(double share) const {
  const double s = MinimumJerk(share);
  if (circular) {
    const Eigen::AngleAxisd turn(s * angle, axis);
    return Eigen::Translation3d(center) * turn * Eigen::Translation3d(-center) * from;
  }
  const Vector3d line = to.translation() - from.translation();
  Isometry3d at = Isometry3d::Identity();
  at.linear() = Quaterniond(from.linear()).slerp(s, Quaterniond(to.linear())).toRotationMatrix();
  at.translation() =
      from.translation() + s * line + 3 * s * (1 - s) * ((1 - s) * early_bend + s * late_bend);
  return at;
}

}  // namespace prospect::sim
