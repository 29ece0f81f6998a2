#include "sim/husky.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prospect::sim {
namespace {

constexpr double kStep = 0.01;

class HuskyTest : public testing::Test {
 protected:
  HuskyTest() : robot_(&world_) {}

  void Drive(const Twist2& command, double seconds) {
    for (int i = 0; i < std::lround(seconds / kStep); ++i) {
      robot_.Drive(command, kStep);
      world_.Step(kStep);
    }
  }

  OdeWorld world_;
  Husky robot_;
};

TEST_F(HuskyTest, StandsStillWhereItIsPut) {
  robot_.Place({1, -2, 0.7});
  Drive({}, 5);
  const Pose2 pose = robot_.pose();
  EXPECT_NEAR(pose.x, 1, 1e-3);
  EXPECT_NEAR(pose.y, -2, 1e-3);
  EXPECT_NEAR(pose.yaw, 0.7, 1e-3);
  EXPECT_NEAR(robot_.ChassisPose().translation().z(), 0.26, 0.01);
}

TEST_F(HuskyTest, DrivesForwardAtTheSpeedAskedFor) {
  robot_.Place({0, 0, 0.5});
  Drive({0.8, 0}, 1);
  const Pose2 before = robot_.pose();
  Drive({0.8, 0}, 2);
  const Pose2 after = robot_.pose();
  EXPECT_NEAR(std::hypot(after.x - before.x, after.y - before.y), 1.6, 0.03);
  EXPECT_NEAR(std::atan2(after.y - before.y, after.x - before.x), 0.5, 0.01);
  EXPECT_NEAR(robot_.velocity().forward, 0.8, 0.02);
}

TEST_F(HuskyTest, SkidsAroundItsCentre) {
  robot_.Place({0, 0, 0});
  Drive({0, 1.0}, 2);
  const Pose2 pose = robot_.pose();
  EXPECT_NEAR(pose.yaw, 2.0, 0.25);
  EXPECT_LT(std::hypot(pose.x, pose.y), 0.02);
}

TEST_F(HuskyTest, KeepsItsLimits) {
  robot_.Place({0, 0, 0});
  Drive({9, 0}, 0.1);
  EXPECT_LT(robot_.velocity().forward, 0.35);  // 3 m/s^2
  Drive({9, 0}, 2);
  EXPECT_LT(robot_.velocity().forward, 1.02);
}

TEST_F(HuskyTest, SavesAndRestoresExactly) {
  robot_.Place({0, 0, 0});
  Drive({0.7, 0.4}, 1.3);
  const Husky::State state = robot_.Save();
  Drive({0.2, -0.9}, 2);
  const Pose2 first = robot_.pose();
  robot_.Restore(state);
  Drive({0.2, -0.9}, 2);
  EXPECT_EQ(first.x, robot_.pose().x);
  EXPECT_EQ(first.y, robot_.pose().y);
  EXPECT_EQ(first.yaw, robot_.pose().yaw);
}

TEST_F(HuskyTest, TouchesAtItsHull) {
  robot_.Place({0, 0, 0});
  const double face = Husky::Hull().half_x;
  const dGeomID post = dCreateCylinder(nullptr, 0.3, 1);
  dGeomSetPosition(post, face + 0.31, 0, 0.5);
  EXPECT_FALSE(robot_.Touches(post));
  dGeomSetPosition(post, face + 0.29, 0, 0.5);
  EXPECT_TRUE(robot_.Touches(post));
  dGeomDestroy(post);
}

}  // namespace
}  // namespace prospect::sim
