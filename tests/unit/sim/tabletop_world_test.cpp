// The physics of the table top: what is held stays held, what stands stays standing.

#include "sim/tabletop/tabletop_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <thread>

#include "base/hash.h"
#include "sim/tabletop/scene_file.h"

namespace prospect::sim {
namespace {

const JointVector kStart = {0.30, -1.33, -1.80, -0.27, 1.50, 1.60};

TabletopDescription Scene() { return ReadTabletop(OpenSceneFile("")); }

Eigen::Isometry3d At(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

// Arm at the start, blocks in a row, obstacle out of the way.
void LayOut(TabletopWorld* world) {
  world->arm().Place(kStart, 0.08);
  for (int i = 0; i < 4; ++i) world->loose().Place(i, At(-0.5, -0.2 + 0.12 * i, 0.025));
  world->loose().Place(4, At(-0.35, 0.35, 0.1));
}

// Joint speeds that hold `q`.
void Hold(TabletopWorld* world, const JointVector& q) {
  const JointVector now = world->arm().joints();
  JointVector speeds;
  for (int i = 0; i < 6; ++i) speeds[i] = 5 * (q[i] - now[i]);
  world->arm().DriveJoints(speeds);
}

void RunFor(TabletopWorld* world, const JointVector& q, double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / world->step()));
  for (int i = 0; i < steps; ++i) {
    Hold(world, q);
    world->Step();
  }
}

Eigen::Vector3d Where(const TabletopWorld& world, int i) {
  return world.loose().body(i).frame().translation();
}

TEST(TabletopWorld, HingesAgreeWithTheKinematics) {
  TabletopWorld world(Scene());
  LayOut(&world);
  const JointVector now = world.arm().joints();
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(now[i], kStart[i], 1e-9);
  const TabletopDescription scene = Scene();
  const Eigen::Isometry3d flange = scene.arm.base * UrKinematics(scene.arm.lengths).Flange(kStart);
  EXPECT_TRUE(world.arm().flange().isApprox(flange, 1e-9));
}

TEST(TabletopWorld, MotorsCarryTheArm) {
  TabletopWorld world(Scene());
  LayOut(&world);
  RunFor(&world, kStart, 3);
  const JointVector now = world.arm().joints();
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(now[i], kStart[i], 1e-3) << "joint " << i;
}

TEST(TabletopWorld, MotorsTurnTheJointsAtTheSpeedAskedFor) {
  TabletopWorld world(Scene());
  LayOut(&world);
  const int half_a_second = static_cast<int>(std::lround(0.5 / world.step()));
  for (int i = 0; i < half_a_second; ++i) {
    world.arm().DriveJoints({0.2, -0.1, 0.15, 0.3, -0.2, 0.4});
    world.Step();
  }
  const JointVector now = world.arm().joints();
  EXPECT_NEAR(now[0] - kStart[0], 0.10, 2e-3);
  EXPECT_NEAR(now[1] - kStart[1], -0.05, 2e-3);
  EXPECT_NEAR(now[5] - kStart[5], 0.20, 2e-3);
  // And not faster than the limits.
  world.arm().DriveJoints({100, 0, 0, 0, 0, 0});
  for (int i = 0; i < 100; ++i) world.Step();
  EXPECT_LE(world.arm().joint_speeds()[0], 3.1416 + 1e-3);
}

TEST(TabletopWorld, EnergyDoesNotGrowAtRest) {
  TabletopWorld world(Scene());
  LayOut(&world);
  RunFor(&world, kStart, 0.5);
  const double before = world.Energy();
  RunFor(&world, kStart, 5);
  EXPECT_LE(world.Energy(), before + 1e-3);
}

TEST(TabletopWorld, AStackOfTwoStandsStill) {
  TabletopDescription scene = Scene();
  for (const double sleep_after : {scene.physics.sleep_after, 1000.0}) {  // asleep and awake
    scene.physics.sleep_after = std::min(sleep_after, 10.0);
    TabletopWorld world(scene);
    LayOut(&world);
    world.loose().Place(1, At(-0.497, -0.195, 0.0755));
    RunFor(&world, kStart, 0.4);
    const Eigen::Vector3d before = Where(world, 1);
    EXPECT_NEAR(before.z(), 0.075, 2e-3);
    RunFor(&world, kStart, 10);
    EXPECT_LT((Where(world, 1) - before).norm(), 5e-4);
  }
}

// Brings the open gripper about block 0 where it floats, closes it and takes the table away from
// under the block by never having it there: only friction holds it.
double CreepOfHeldBlock(double seconds) {
  TabletopWorld world(Scene());
  LayOut(&world);
  world.arm().Place(kStart, 0.0502);
  world.loose().Place(0, world.arm().tool());
  world.arm().DriveGripper(0, 22);
  RunFor(&world, kStart, 0.35);
  const Eigen::Vector3d before = world.arm().tool().inverse() * Where(world, 0);
  EXPECT_LT(before.norm(), 0.03) << "the block fell before it was held";
  RunFor(&world, kStart, seconds);
  return (world.arm().tool().inverse() * Where(world, 0) - before).norm();
}

TEST(TabletopWorld, AHeldBlockDoesNotCreep) {
  const double creep = CreepOfHeldBlock(5);
  EXPECT_LT(creep, 1e-3);
  RecordProperty("creep_m", std::to_string(creep));
}

TEST(TabletopWorld, AnOpenGripperLetsGo) {
  TabletopWorld world(Scene());
  LayOut(&world);
  world.arm().Place(kStart, 0.0502);
  world.loose().Place(0, world.arm().tool());
  world.arm().DriveGripper(0, 22);
  RunFor(&world, kStart, 0.5);
  world.arm().DriveGripper(0.085, 22);
  RunFor(&world, kStart, 1.5);
  EXPECT_LT(Where(world, 0).z(), 0.06);
}

TEST(TabletopWorld, AWeakGripSlips) {
  TabletopWorld world(Scene());
  LayOut(&world);
  world.arm().Place(kStart, 0.0502);
  world.loose().Place(0, world.arm().tool());
  world.arm().DriveGripper(0, 22);
  RunFor(&world, kStart, 0.4);
  world.arm().DriveGripper(0, 0.1);
  RunFor(&world, kStart, 2);
  EXPECT_LT(Where(world, 0).z(), 0.06);
}

TEST(TabletopWorld, WhatLiesStillSleepsAndWakesWithItsNeighbour) {
  TabletopWorld world(Scene());
  LayOut(&world);
  world.loose().Place(1, At(-0.503, -0.197, 0.0755));
  RunFor(&world, kStart, 1);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(world.loose().asleep(i)) << i;
  world.loose().Wake(0);
  EXPECT_FALSE(world.loose().asleep(1));
  EXPECT_TRUE(world.loose().asleep(3));
}

// Every pair of shapes that may touch the obstacle must be known to ODE.
TEST(TabletopWorld, SeesTheObstacleTouchedByEveryPart) {
  const TabletopDescription scene = Scene();
  const auto touched = [&](const Eigen::Isometry3d& where) {
    TabletopWorld world(scene);
    LayOut(&world);
    world.loose().Place(4, where);
    world.Step();
    return world.touches().obstacle;
  };
  TabletopWorld world(scene);
  LayOut(&world);
  EXPECT_EQ(touched(At(-0.35, 0.35, 0.1)), Touches::Part::kNone);
  for (int i = 0; i < ArmChain::kBodies; ++i) {
    for (const CollisionShape& shape : world.arm().body(i).shapes()) {
      const dReal* p = dGeomGetPosition(shape.geom);
      const auto part = i < 5 ? Touches::Part::kArm : Touches::Part::kGripper;
      EXPECT_EQ(touched(At(p[0] - 0.02, p[1], p[2] - 0.09)), part) << "body " << i;
    }
  }
}

std::uint64_t RunHash() {
  OdeWorld::PrepareThread();
  TabletopWorld world(Scene());
  LayOut(&world);
  world.loose().Place(2, At(-0.5, -0.2, 0.13));  // falls onto another
  for (int i = 0; i < 500; ++i) {
    world.arm().DriveJoints({0.2, -0.1, 0.15, 0.3, -0.2, 0.4});
    world.Step();
  }
  std::uint64_t hash = 1;
  for (const BodyState& body : world.Save().bodies) {
    hash = base::HashBytes(body.position, sizeof body.position, hash);
  }
  return hash;
}

TEST(TabletopWorld, RepeatsBitForBitAlsoInThreads) {
  const std::uint64_t alone = RunHash();
  EXPECT_EQ(RunHash(), alone);
  std::uint64_t hashes[3] = {};
  std::vector<std::thread> threads;
  for (std::uint64_t& hash : hashes) threads.emplace_back([&hash] { hash = RunHash(); });
  for (std::thread& thread : threads) thread.join();
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, alone);
}

TEST(TabletopWorld, GoesOnFromASavedState) {
  TabletopWorld world(Scene());
  LayOut(&world);
  world.loose().Place(2, At(-0.5, -0.2, 0.13));
  RunFor(&world, kStart, 0.05);
  const TabletopWorld::State saved = world.Save();
  RunFor(&world, kStart, 0.3);
  const Eigen::Vector3d first = Where(world, 2);
  TabletopWorld other(Scene());
  LayOut(&other);
  other.Restore(saved);
  RunFor(&other, kStart, 0.3);
  EXPECT_EQ(Where(other, 2), first);
}

}  // namespace
}  // namespace prospect::sim
