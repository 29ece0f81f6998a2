#include "sim/arm/ur_kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace prospect::sim {
namespace {

constexpr double kTurn = 2 * M_PI;
// Below this sin q5 the direction that gives q6 is rounding noise.
constexpr double kSingular = 1e-10;
// How far beyond straight the elbow may seem to be by rounding.
constexpr double kStraight = 1e-12;

double Wrapped(double angle) { return std::remainder(angle, kTurn); }

Eigen::Isometry3d DhStep(double q, double d, double a, double alpha_sign) {
  const double c = std::cos(q);
  const double s = std::sin(q);
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  // alpha is 0 or a quarter turn either way, so its cosine and sine are exact.
  if (alpha_sign == 0) {
    t.linear() << c, -s, 0, s, c, 0, 0, 0, 1;
  } else {
    t.linear() << c, 0, alpha_sign * s, s, 0, -alpha_sign * c, 0, alpha_sign, 0;
  }
  t.translation() << a * c, a * s, d;
  return t;
}

bool IsPose(const Eigen::Isometry3d& pose) {
  if (!pose.matrix().allFinite()) return false;
  const Eigen::Matrix3d error =
      pose.linear().transpose() * pose.linear() - Eigen::Matrix3d::Identity();
  return error.cwiseAbs().maxCoeff() < 1e-6 && pose.linear().determinant() > 0;
}

// The turn of `angle` that is nearest to `reference` and within `limit`.
bool Unwind(double reference, double limit, double* angle) {
  *angle = reference + Wrapped(*angle - reference);
  if (*angle > limit) *angle -= kTurn;
  if (*angle < -limit) *angle += kTurn;
  return std::abs(*angle) <= limit;
}

}  // namespace

std::array<Eigen::Isometry3d, 6> UrKinematics::Frames(const JointVector& q) const {
  std::array<Eigen::Isometry3d, 6> frames;
  frames[0] = DhStep(q[0], l_.d1, 0, 1);
  frames[1] = frames[0] * DhStep(q[1], 0, l_.a2, 0);
  frames[2] = frames[1] * DhStep(q[2], 0, l_.a3, 0);
  frames[3] = frames[2] * DhStep(q[3], l_.d4, 0, 1);
  frames[4] = frames[3] * DhStep(q[4], l_.d5, 0, -1);
  frames[5] = frames[4] * DhStep(q[5], l_.d6, 0, 0);
  return frames;
}

Eigen::Isometry3d UrKinematics::Flange(const JointVector& q) const { return Frames(q)[5]; }

// The axes of joints 2, 3 and 4 are parallel to z1 = (sin q1, -cos q1, 0). The wrist centre
// p5 = p - d6 z6 lies d4 along z1 from the base's axis: sin(q1 - phi) |p5| = d4.
std::vector<JointVector> UrKinematics::Inverse(const Eigen::Isometry3d& flange,
                                               double singular_q6) const {
  std::vector<JointVector> solutions;
  if (!IsPose(flange)) return solutions;
  const Eigen::Vector3d p5 = flange.translation() - l_.d6 * flange.linear().col(2);
  const double radius = std::hypot(p5.x(), p5.y());
  if (radius < std::abs(l_.d4)) return solutions;
  const double phi = std::atan2(p5.y(), p5.x());
  const double offset = std::asin(l_.d4 / radius);
  SolveWrist(flange, Wrapped(phi + offset), singular_q6, &solutions);
  SolveWrist(flange, Wrapped(phi + M_PI - offset), singular_q6, &solutions);
  return solutions;
}

// In the flange's frame z1 is (sin q5 cos q6, -sin q5 sin q6, cos q5). The arc tangent of both
// keeps full precision where an arc cosine would lose half of it.
void UrKinematics::SolveWrist(const Eigen::Isometry3d& flange, double q1, double singular_q6,
                              std::vector<JointVector>* solutions) const {
  const Eigen::Vector3d z1(std::sin(q1), -std::cos(q1), 0);
  const Eigen::Vector3d seen = flange.linear().transpose() * z1;
  const double sine = std::hypot(seen.x(), seen.y());
  if (sine < kSingular) {
    SolveElbow(flange, q1, seen.z() > 0 ? 0 : M_PI, Wrapped(singular_q6), solutions);
    return;
  }
  for (const double sign : {1.0, -1.0}) {
    const double q5 = std::atan2(sign * sine, seen.z());
    const double q6 = std::atan2(-sign * seen.y(), sign * seen.x());
    SolveElbow(flange, q1, q5, q6, solutions);
  }
}

// What is left is a planar arm of two links, from frame 1 to frame 4, and the sum of its angles.
void UrKinematics::SolveElbow(const Eigen::Isometry3d& flange, double q1, double q5, double q6,
                              std::vector<JointVector>* solutions) const {
  const Eigen::Isometry3d wrist = DhStep(q5, l_.d5, 0, -1) * DhStep(q6, l_.d6, 0, 0);
  const Eigen::Isometry3d t14 = DhStep(q1, l_.d1, 0, 1).inverse() * flange * wrist.inverse();
  const double x = t14.translation().x();
  const double y = t14.translation().y();
  const double sum = std::atan2(t14.linear()(1, 0), t14.linear()(0, 0));
  const double cosine = (x * x + y * y - l_.a2 * l_.a2 - l_.a3 * l_.a3) / (2 * l_.a2 * l_.a3);
  if (std::abs(cosine) > 1 + kStraight) return;
  const double elbow = std::acos(std::clamp(cosine, -1.0, 1.0));
  for (const double q3 : {elbow, -elbow}) {
    const double q2 =
        std::atan2(y, x) - std::atan2(l_.a3 * std::sin(q3), l_.a2 + l_.a3 * std::cos(q3));
    solutions->push_back({q1, Wrapped(q2), q3, Wrapped(sum - q2 - q3), q5, q6});
  }
}

std::optional<JointVector> UrKinematics::Nearest(const Eigen::Isometry3d& flange,
                                                 const JointVector& reference, double limit) const {
  std::optional<JointVector> best;
  double least = std::numeric_limits<double>::infinity();
  for (JointVector q : Inverse(flange, reference[5])) {
    double distance = 0;
    bool within = true;
    for (int i = 0; i < 6; ++i) {
      within = Unwind(reference[i], limit, &q[i]) && within;
      distance += (q[i] - reference[i]) * (q[i] - reference[i]);
    }
    if (!within || distance >= least) continue;
    least = distance;
    best = q;
  }
  return best;
}

}  // namespace prospect::sim
