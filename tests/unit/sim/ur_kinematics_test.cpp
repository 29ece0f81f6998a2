#include "sim/arm/ur_kinematics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"

namespace prospect::sim {
namespace {

JointVector RandomJoints(base::Random* random) {
  JointVector q;
  for (double& angle : q) angle = random->Uniform(-M_PI, M_PI);
  return q;
}

double Gap(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

double Apart(const JointVector& a, const JointVector& b) {
  double most = 0;
  for (int i = 0; i < 6; ++i) {
    most = std::max(most, std::abs(std::remainder(a[i] - b[i], 2 * M_PI)));
  }
  return most;
}

TEST(UrKinematics, StandsUprightAsTheManualDrawsIt) {
  // All joints at zero: the arm lies stretched along -x, the wrist's offsets add up along -y.
  const Eigen::Isometry3d stretched = UrKinematics().Flange({});
  EXPECT_NEAR(stretched.translation().x(), -0.425 - 0.39225, 1e-12);
  EXPECT_NEAR(stretched.translation().y(), -0.10915 - 0.0823, 1e-12);
  EXPECT_NEAR(stretched.translation().z(), 0.089159 - 0.09465, 1e-12);
  // Upper arm and forearm straight up.
  const Eigen::Isometry3d up = UrKinematics().Flange({0, -M_PI / 2, 0, -M_PI / 2, 0, 0});
  EXPECT_NEAR(up.translation().z(), 0.089159 + 0.425 + 0.39225 + 0.09465, 1e-12);
}

TEST(UrKinematics, ForwardUndoesInverseOnManyRandomPoses) {
  const UrKinematics arm;
  base::Random random(7);
  double worst = 0;
  int solutions = 0;
  for (int i = 0; i < 100'000; ++i) {
    const JointVector q = RandomJoints(&random);
    const Eigen::Isometry3d flange = arm.Flange(q);
    double nearest = 10;
    for (const JointVector& found : arm.Inverse(flange)) {
      worst = std::max(worst, Gap(arm.Flange(found), flange));
      nearest = std::min(nearest, Apart(found, q));
      ++solutions;
    }
    // The joints that the pose was made of are among the answers.
    ASSERT_LT(nearest, 1e-4) << "pose " << i;
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(solutions, 400'000);
  EXPECT_LE(solutions, 800'000);
}

TEST(UrKinematics, WorksWhereTheWristIsSingular) {
  const UrKinematics arm;
  base::Random random(8);
  for (int i = 0; i < 2'000; ++i) {
    JointVector q = RandomJoints(&random);
    q[4] = i % 2 == 0 ? 0 : M_PI;
    q[4] += (i % 5) * 1e-11;  // and right beside the singularity
    const Eigen::Isometry3d flange = arm.Flange(q);
    const std::optional<JointVector> found = arm.Nearest(flange, q);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(Gap(arm.Flange(*found), flange), 1e-9);
    EXPECT_LT(Apart(*found, q), 1e-3) << "joint 6 keeps its angle, so joint 4 does, too";
  }
}

TEST(UrKinematics, WorksWhereTheElbowIsStraight) {
  const UrKinematics arm;
  base::Random random(9);
  for (int i = 0; i < 2'000; ++i) {
    JointVector q = RandomJoints(&random);
    q[2] = (i % 3) * 1e-9;
    const Eigen::Isometry3d flange = arm.Flange(q);
    const std::optional<JointVector> found = arm.Nearest(flange, q);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(Gap(arm.Flange(*found), flange), 1e-9);
  }
}

TEST(UrKinematics, NearestStaysWithTheArmAlongASmoothPath) {
  const UrKinematics arm;
  JointVector q = {0.30, -1.33, -1.80, -0.27, 1.50, 1.60};
  for (int i = 0; i < 400; ++i) {
    Eigen::Isometry3d next = arm.Flange(q);
    next.translation().y() += 0.0005;
    const std::optional<JointVector> found = arm.Nearest(next, q);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(Apart(*found, q), 0.01) << "step " << i;
    q = *found;
  }
}

TEST(UrKinematics, NearestKeepsWithinTheLimit) {
  const UrKinematics arm;
  const JointVector wound = {0.2, -1.2, 1.0, 3.5, 1.0, 5.0};
  const Eigen::Isometry3d flange = arm.Flange(wound);
  const std::optional<JointVector> free = arm.Nearest(flange, wound);
  ASSERT_TRUE(free.has_value());
  EXPECT_NEAR(free->at(5), 5.0, 1e-9);
  const std::optional<JointVector> limited = arm.Nearest(flange, wound, M_PI);
  ASSERT_TRUE(limited.has_value());
  for (double angle : *limited) EXPECT_LE(std::abs(angle), M_PI);
  EXPECT_LT(Gap(arm.Flange(*limited), flange), 1e-9);
}

TEST(UrKinematics, RefusesWhatIsOutOfReachOrNoPose) {
  const UrKinematics arm;
  Eigen::Isometry3d pose = arm.Flange({0.1, -1.0, 1.2, 0.3, 0.8, 0});
  pose.translation().x() = 1.4;
  EXPECT_TRUE(arm.Inverse(pose).empty());
  EXPECT_FALSE(arm.Nearest(pose, {}).has_value());
  pose.translation().setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(arm.Inverse(pose).empty());
  pose = arm.Flange({});
  pose.linear() *= 2;
  EXPECT_TRUE(arm.Inverse(pose).empty());
  // Right above the base nothing reaches: the shoulder's offset keeps the wrist away.
  pose = Eigen::Isometry3d::Identity();
  pose.translation() << 0, 0, 0.6;
  EXPECT_TRUE(arm.Inverse(pose).empty());
}

TEST(UrKinematics, OtherArmsOfTheFamily) {
  const UrKinematics ur10e({0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655});
  base::Random random(10);
  for (int i = 0; i < 1'000; ++i) {
    const JointVector q = RandomJoints(&random);
    const std::optional<JointVector> found = ur10e.Nearest(ur10e.Flange(q), q);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(Gap(ur10e.Flange(*found), ur10e.Flange(q)), 1e-9);
  }
}

}  // namespace
}  // namespace prospect::sim
