#include "sim/navigation/navigation_task.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/navigation/catalogue.h"
#include "sim/rollout.h"

namespace prospect::sim {
namespace {

constexpr int kBarrel = 0, kBarricade = 1, kPylon = 2, kBlock = 3;

// The paper's four on a cross around an empty centre; every object can be reached from the start.
NavigationScene Cross() {
  NavigationScene scene;
  scene.objects = {{kBarrel, {2.5, 0, 0}},
                   {kBarricade, {0, 2.5, 0}},
                   {kPylon, {-2.5, 0, 0}},
                   {kBlock, {0, -2.5, 0}}};
  return scene;
}

class NavigationTest : public testing::Test {
 protected:
  NavigationTest() : task_(TaskOptions{}) {}

  // Runs one leg from the scene's start.
  Progress Leg(const NavigationScene& scene, int action) {
    task_.ResetTo(scene, 1);
    RunAction(task_, action, nullptr);
    return task_.progress();
  }

  double Gap(int action) {
    const std::vector<double> s = task_.RobotState();
    for (const PlacedObject& object : task_.scene().objects) {
      if (object.kind == action) return DistanceToHull(object, {s[0], s[1], s[2]});
    }
    return -1;
  }

  NavigationTask task_;
};

TEST_F(NavigationTest, StartsWithTheNullAction) {
  task_.Reset(4);
  const Progress progress = task_.progress();
  EXPECT_EQ(progress.action, 7);
  EXPECT_EQ(progress.previous_action, 7);
  EXPECT_EQ(progress.segment, -1);
  EXPECT_EQ(progress.action_state, ActionState::kIdle);
  EXPECT_EQ(progress.outcome, Outcome::kRunning);
  EXPECT_EQ(progress.time, 0);
  EXPECT_EQ(task_.LegalActions(), (std::vector<int>{0, 1, 2, 3}));
}

TEST_F(NavigationTest, ALegEndsAtRestWithinReachAndFacingTheObject) {
  for (int action : {kBarrel, kBarricade, kPylon, kBlock}) {
    const Progress progress = Leg(Cross(), action);
    EXPECT_EQ(progress.action_state, ActionState::kSucceeded) << action;
    EXPECT_EQ(progress.actions_done, 1);
    EXPECT_LE(Gap(action), 0.5);
    EXPECT_GT(Gap(action), 0.3);
    const std::vector<double> s = task_.RobotState();
    EXPECT_LT(std::abs(s[3]), 0.05);
    const Pose2& target = task_.scene().objects[action].pose;
    EXPECT_LT(std::abs(WrapAngle(std::atan2(target.y - s[1], target.x - s[0]) - s[2])), 0.15);
  }
}

TEST_F(NavigationTest, ThreeLegsMakeASuccess) {
  task_.ResetTo(Cross(), 1);
  const RolloutResult result = RunPlan(task_, {kBarrel, kBarricade, kPylon}, nullptr);
  EXPECT_EQ(result.outcome, Outcome::kSuccess);
  EXPECT_EQ(result.actions_done, 3);
  EXPECT_EQ(task_.Facts(),
            (std::vector<std::string>{"visited(barrel)", "visited(barricade)", "visited(pylon)"}));
  EXPECT_EQ(task_.progress().segment, 2);
  EXPECT_EQ(task_.progress().action, kPylon);
  EXPECT_EQ(task_.progress().previous_action, kBarricade);
  EXPECT_TRUE(task_.LegalActions().empty());
  EXPECT_FALSE(task_.StartAction(kBlock));
}

TEST_F(NavigationTest, AnObjectInTheWayIsHitAndNamed) {
  NavigationScene scene = Cross();
  scene.start = {-0.8, 0, 0};
  scene.objects[kBlock].pose = {1.0, 0.1, 0.3};
  const Progress progress = Leg(scene, kBarrel);
  EXPECT_EQ(progress.outcome, Outcome::kFailure);
  EXPECT_EQ(progress.reason, "collision(block)");
  EXPECT_EQ(progress.action_state, ActionState::kFailed);
  EXPECT_LT(Gap(kBlock), 0.02);
}

TEST_F(NavigationTest, TheHullSweepsWhenItTurns) {
  NavigationScene scene = Cross();
  scene.objects[kPylon].pose = {0.30, 0.70,
                                0};  // free of the hull, inside the circle of its corners
  const Progress progress = Leg(scene, kBarricade);
  EXPECT_EQ(progress.reason, "collision(pylon)");
}

TEST_F(NavigationTest, TooFarForTheTimeLimit) {
  NavigationScene scene = Cross();
  scene.start = {-3.0, -3.0, -3 * M_PI / 4};  // facing away
  scene.objects[kBarrel].pose = {3.0, 3.0, 0};
  const Progress progress = Leg(scene, kBarrel);
  EXPECT_EQ(progress.outcome, Outcome::kFailure);
  EXPECT_EQ(progress.reason, "time");
  EXPECT_NEAR(progress.time, 10.0, 0.15);
}

TEST_F(NavigationTest, ACornerOverTheBorderLeavesTheSite) {
  NavigationScene scene = Cross();
  scene.objects[kBarrel].pose = {2.5, -2.5, 0};
  scene.start = {3.4, 0, M_PI / 2};
  const Progress progress = Leg(scene, kPylon);
  EXPECT_EQ(progress.outcome, Outcome::kFailure);
  EXPECT_EQ(progress.reason, "left_site");
}

TEST_F(NavigationTest, NothingMovesOnceTheTrialIsOver) {
  NavigationScene scene = Cross();
  scene.start = {-0.8, 0, 0};
  scene.objects[kBlock].pose = {1.0, 0.1, 0.3};
  Leg(scene, kBarrel);
  const std::vector<double> state = task_.RobotState();
  const double time = task_.progress().time;
  task_.Tick();
  EXPECT_EQ(task_.RobotState(), state);
  EXPECT_NEAR(task_.progress().time, time + 0.1, 1e-9);
  EXPECT_TRUE(task_.LegalActions().empty());
}

TEST_F(NavigationTest, RefusesIllegalActionsAndChangesNothing) {
  task_.ResetTo(Cross(), 1);
  for (int action : {-1, 4, 7, 99}) EXPECT_FALSE(task_.StartAction(action)) << action;
  EXPECT_EQ(task_.progress().segment, -1);
  RunAction(task_, kBarrel, nullptr);
  EXPECT_FALSE(task_.StartAction(kBarrel));  // visited
  EXPECT_EQ(task_.LegalActions(), (std::vector<int>{1, 2, 3}));
  EXPECT_TRUE(task_.StartAction(kPylon));
  EXPECT_FALSE(task_.StartAction(kBlock));  // one at a time
  EXPECT_EQ(task_.progress().action, kPylon);
}

TEST_F(NavigationTest, CancelStopsTheRobotAndLeavesTheObjectOpen) {
  task_.ResetTo(Cross(), 1);
  ASSERT_TRUE(task_.StartAction(kBarrel));
  for (int i = 0; i < 15; ++i) task_.Tick();
  EXPECT_GT(task_.RobotState()[3], 0.3);
  task_.Cancel();
  EXPECT_EQ(task_.progress().action_state, ActionState::kCancelled);
  for (int i = 0; i < 5; ++i) task_.Tick();
  const std::vector<double> stopped = task_.RobotState();
  EXPECT_LT(std::abs(stopped[3]), 0.01);
  for (int i = 0; i < 20; ++i) task_.Tick();
  EXPECT_NEAR(task_.RobotState()[0], stopped[0], 0.005);
  EXPECT_EQ(task_.progress().outcome, Outcome::kRunning);
  EXPECT_EQ(task_.progress().actions_done, 0);
  EXPECT_TRUE(RunAction(task_, kBarrel, nullptr));
  EXPECT_EQ(task_.progress().action_state, ActionState::kSucceeded);
  EXPECT_EQ(task_.progress().segment, 1);
}

TEST_F(NavigationTest, HoldsStillWithoutAnAction) {
  task_.ResetTo(Cross(), 1);
  const std::vector<double> before = task_.RobotState();
  for (int i = 0; i < 50; ++i) task_.Tick();
  EXPECT_NEAR(task_.RobotState()[0], before[0], 1e-3);
  EXPECT_NEAR(task_.RobotState()[2], before[2], 1e-3);
  EXPECT_NEAR(task_.progress().time, 5.0, 1e-9);
}

TEST_F(NavigationTest, NoiseMovesTheEndOfALegALittle) {
  double low = 1e9, high = -1e9;
  for (std::uint64_t noise = 0; noise < 12; ++noise) {
    task_.ResetTo(Cross(), noise);
    RunAction(task_, kBarrel, nullptr);
    low = std::min(low, task_.RobotState()[1]);
    high = std::max(high, task_.RobotState()[1]);
  }
  EXPECT_GT(high - low, 0.01);
  EXPECT_LT(high - low, 0.30);
}

// The robot's landmark is where its pixels are: the middle of what differs, on the picture's left
// half, from the same site with the robot on the right.
TEST_F(NavigationTest, TheRobotsLandmarkIsWhereThePictureShowsIt) {
  NavigationScene scene = Cross();
  scene.start = {-1.2, 1.5, 0.7};
  task_.ResetTo(scene, 1);
  const Image with = task_.Observe();
  const Landmark robot = task_.Landmarks()[7];
  const Landmark front = task_.Landmarks()[8];
  scene.start = {1.8, -1.5, 0};
  task_.ResetTo(scene, 1);
  const Image without = task_.Observe();
  double sum = 0, u = 0, v = 0;
  for (int i = 0; i < 64 * 64; ++i) {
    if (i % 64 >= 32) continue;
    const int difference = std::abs(with.rgb[3 * i] - without.rgb[3 * i]);
    sum += difference;
    u += difference * (i % 64 + 0.5) / 64;
    v += difference * (i / 64 + 0.5) / 64;
  }
  ASSERT_GT(sum, 0);
  EXPECT_NEAR(u / sum, robot.u, 0.02);
  EXPECT_NEAR(v / sum, robot.v, 0.02);
  EXPECT_NEAR(std::atan2(robot.v - front.v, front.u - robot.u), 0.7, 1e-6);
}

TEST_F(NavigationTest, LandmarksOfObjectsThatAreNotThereAreNowhere) {
  task_.ResetTo(Cross(), 1);
  const std::vector<Landmark> landmarks = task_.Landmarks();
  ASSERT_EQ(landmarks.size(), task_.spec().landmarks.size());
  EXPECT_DOUBLE_EQ(landmarks[kBarrel].u, 0.5 + 2.5 / 7.68);
  EXPECT_DOUBLE_EQ(landmarks[kBarricade].v, 0.5 - 2.5 / 7.68);
  EXPECT_TRUE(std::isnan(landmarks[4].u));
}

TEST_F(NavigationTest, PresentActionsFollowTheScene) {
  task_.Reset(1);
  EXPECT_EQ(task_.PresentActions(),
            (std::vector<bool>{true, true, true, true, false, false, false}));
  NavigationTask full({7, 5});
  full.Reset(1);
  EXPECT_EQ(full.PresentActions(), std::vector<bool>(7, true));
}

}  // namespace
}  // namespace prospect::sim
