#include "sim/stacking/stacking_task.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>
#include <thread>

#include "base/hash.h"
#include "sim/rollout.h"
#include "sim/tabletop/scene_file.h"

namespace prospect::sim {
namespace {

constexpr int kBlocks = 4;

int Action(StackingKind kind, int block) { return StackingIndex(kind, block, kBlocks); }

// The whole plan that puts `pick` on `place`.
std::vector<int> Plan(int pick, int place) {
  std::vector<int> plan;
  for (int kind = 0; kind < kStackingKinds; ++kind) {
    const bool picks = kind < static_cast<int>(StackingKind::kAlignOver);
    plan.push_back(Action(static_cast<StackingKind>(kind), picks ? pick : place));
  }
  return plan;
}

Eigen::Isometry3d At(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

// Red, blue, yellow and green far apart, the obstacle out of the way.
StackingScene OpenScene() {
  StackingScene scene;
  scene.blocks = {At(-0.46, 0.1, 0.025), At(-0.46, -0.1, 0.025), At(-0.5, 0.25, 0.025),
                  At(-0.4, -0.25, 0.025)};
  scene.obstacle = At(-0.75, 0.3, 0.1);
  scene.joints = {0.30, -1.33, -1.80, -0.27, 1.50, 1.60};
  return scene;
}

// The default scene file with all noise at zero.
TaskOptions Quiet() {
  static const std::string path = [] {
    YAML::Node root = YAML::Load(DefaultStackingScene());
    for (const char* part : {"grip", "place", "speed", "release_delay", "early_release"}) {
      root["stacking"]["noise"][part] = 0;
    }
    const std::string file = testing::TempDir() + "quiet_stacking.yaml";
    std::ofstream(file) << YAML::Dump(root);
    return file;
  }();
  TaskOptions options;
  options.scene_file = path;
  return options;
}

TEST(StackingTable, IsFrozen) {
  const TaskSpec spec = StackingTask(TaskOptions{}).spec();
  ASSERT_EQ(spec.actions.size(), 36u);
  EXPECT_EQ(spec.actions[0].name, "align(red)");
  EXPECT_EQ(spec.actions[5].name, "grasp(blue)");
  EXPECT_EQ(spec.actions[18].name, "align_over(yellow)");
  EXPECT_EQ(spec.actions[35].name, "home(green)");
  EXPECT_EQ(spec.plan_length, 9);
  // Who changes table or graph changes what weights and logs mean.
  EXPECT_EQ(spec.Hash(), 9475866821051018904ULL);
}

TEST(StackingTable, PlansRunThroughTheKindsAndMayTryAgain) {
  const auto next = StackingSuccessors(kBlocks);
  EXPECT_EQ(next[36], (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(next[Action(StackingKind::kAlign, 2)],
            (std::vector<int>{Action(StackingKind::kGrasp, 2)}));
  EXPECT_EQ(next[Action(StackingKind::kLift, 1)], (std::vector<int>{16, 18, 19}));
  EXPECT_EQ(next[Action(StackingKind::kOpen, 3)], (std::vector<int>{0, 1, 2, 3, 31}));
  EXPECT_EQ(next[Action(StackingKind::kHome, 3)], (std::vector<int>{0, 1, 2, 3}));
  int plans = 0;
  for (int pick : next[36]) {
    for (int place : next[Action(StackingKind::kLift, pick)]) plans += place != pick;
  }
  EXPECT_EQ(plans, 12);
  const TaskSpec spec = StackingTask(TaskOptions{}).spec();
  EXPECT_TRUE(spec.IsRetry(Action(StackingKind::kOpen, 3), 2));
  EXPECT_FALSE(spec.IsRetry(Action(StackingKind::kOpen, 3), 31));
  EXPECT_FALSE(spec.IsRetry(spec.null_action(), 2));
}

TEST(StackingTask, StacksABlockInAnOpenScene) {
  StackingTask task(Quiet());
  task.ResetTo(OpenScene(), 1);
  EXPECT_TRUE(task.Facts().empty());
  const RolloutResult result = RunPlan(task, Plan(0, 1), nullptr);
  EXPECT_EQ(result.outcome, Outcome::kSuccess) << result.reason;
  EXPECT_EQ(result.actions_done, 9);
  const Eigen::Vector3d red = task.world().loose().body(0).frame().translation();
  const Eigen::Vector3d blue = task.world().loose().body(1).frame().translation();
  EXPECT_NEAR(red.z() - blue.z(), 0.05, 2e-3);
  EXPECT_LT((red - blue).head<2>().norm(), 0.02);
  EXPECT_LT(task.progress().time, 20);
  EXPECT_TRUE(task.LegalActions().empty());
  EXPECT_EQ(task.Facts(), (std::vector<std::string>{"on(red,blue)"}));
}

TEST(StackingTask, TouchingTheObstacleEndsTheTrial) {
  StackingTask task(Quiet());
  StackingScene scene = OpenScene();
  scene.obstacle = At(-0.47, 0.03, 0.1);  // between the home point and the red block
  task.ResetTo(scene, 1);
  const RolloutResult result = RunPlan(task, Plan(0, 1), nullptr);
  EXPECT_EQ(result.outcome, Outcome::kFailure);
  EXPECT_EQ(result.reason.rfind("obstacle(", 0), 0u) << result.reason;
  EXPECT_EQ(task.verdict().outcome, StackingOutcome::kObstacle);
  EXPECT_EQ(task.progress().action_state, ActionState::kFailed);
}

// A gripper that cannot hold anything: every carry ends with an open hand.
TEST(StackingTask, APlanWithoutATowerIsExhausted) {
  YAML::Node root = YAML::LoadFile(Quiet().scene_file);
  root["stacking"]["noise"]["early_release"] = 1;
  root["stacking"]["noise"]["place"] = 0;
  TaskOptions options;
  options.scene_file = testing::TempDir() + "clumsy_stacking.yaml";
  std::ofstream(options.scene_file) << YAML::Dump(root);
  StackingTask task(options);
  bool exhausted = false;
  for (std::uint64_t noise = 1; noise <= 4 && !exhausted; ++noise) {
    task.ResetTo(OpenScene(), noise);
    const RolloutResult result = RunPlan(task, Plan(0, 1), nullptr);
    exhausted = result.reason == "plan_exhausted" && result.actions_done == 9;
  }
  EXPECT_TRUE(exhausted);
}

TEST(StackingTask, ABlockOutOfReachIsToldSo) {
  StackingTask task(Quiet());
  StackingScene scene = OpenScene();
  scene.blocks[0] = At(-1.2, 0.5, 0.025);
  task.ResetTo(scene, 1);
  RunPlan(task, {0}, nullptr);
  EXPECT_EQ(task.progress().outcome, Outcome::kFailure);
  EXPECT_EQ(task.progress().reason, "workspace(tool)");
}

TEST(StackingTask, ABlockOffTheTableIsLost) {
  StackingTask task(Quiet());
  StackingScene scene = OpenScene();
  scene.blocks[3] = At(-1.6, 0, 0.025);
  task.ResetTo(scene, 1);
  RunPlan(task, {0}, nullptr);
  EXPECT_EQ(task.progress().reason, "block_lost");
}

TEST(StackingTask, TimeRunsOut) {
  StackingTask task(Quiet());
  task.ResetTo(OpenScene(), 1);
  ASSERT_TRUE(task.StartAction(0));
  task.Cancel();
  for (int i = 0; i < 299; ++i) task.Tick();
  EXPECT_EQ(task.progress().outcome, Outcome::kRunning);
  task.Tick();
  EXPECT_EQ(task.progress().reason, "time");
}

TEST(StackingTask, RefusesWhatTheGraphForbidsAndStaysUnharmed) {
  StackingTask task(Quiet());
  task.ResetTo(OpenScene(), 1);
  const std::vector<double> before = task.RobotState();
  for (int action :
       {-1, 36, 1000, Action(StackingKind::kGrasp, 0), Action(StackingKind::kHome, 1)}) {
    EXPECT_FALSE(task.StartAction(action)) << action;
  }
  EXPECT_EQ(task.RobotState(), before);
  EXPECT_EQ(task.progress().segment, -1);
  ASSERT_TRUE(task.StartAction(0));
  EXPECT_FALSE(task.StartAction(1)) << "another action is running";
}

TEST(StackingTask, ACancelledActionStopsAndStaysLegal) {
  StackingTask task(Quiet());
  task.ResetTo(OpenScene(), 1);
  ASSERT_TRUE(task.StartAction(0));
  for (int i = 0; i < 5; ++i) task.Tick();
  task.Cancel();
  EXPECT_EQ(task.progress().action_state, ActionState::kCancelled);
  for (int i = 0; i < 3; ++i) task.Tick();
  const std::vector<double> still = task.RobotState();
  for (int i = 0; i < 5; ++i) task.Tick();
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(task.RobotState()[i], still[i], 1e-4);
  EXPECT_EQ(task.LegalActions(), (std::vector<int>{0, 1, 2, 3}));
}

TEST(StackingTask, RefusesImpossibleParameters) {
  for (int tower : {-1, 0, 1, 5}) {
    TaskOptions options;
    options.tower = tower;
    EXPECT_THROW(StackingTask{options}, std::invalid_argument) << tower;
  }
  TaskOptions options;
  options.scene_file = "/nowhere.yaml";
  EXPECT_THROW(StackingTask{options}, std::invalid_argument);
  EXPECT_NO_THROW(SetPlanLength("stacking", 18, &options));
  EXPECT_EQ(options.tower, 3);
  EXPECT_THROW(SetPlanLength("stacking", 10, &options), std::invalid_argument);
}

TEST(StackingTask, HigherTowersGiveLongerPlans) {
  TaskOptions options = Quiet();
  options.tower = 3;
  StackingTask task(options);
  EXPECT_EQ(task.spec().plan_length, 18);
  EXPECT_EQ(task.spec().Hash(), StackingTask(Quiet()).spec().Hash());
  task.ResetTo(OpenScene(), 1);
  RunPlan(task, Plan(0, 1), nullptr);
  EXPECT_EQ(task.progress().outcome, Outcome::kRunning) << task.progress().reason;
  EXPECT_EQ(task.LegalActions(), (std::vector<int>{0, 1, 2, 3}));
  RunPlan(task, Plan(3, 0), nullptr);
  EXPECT_EQ(task.progress().outcome, Outcome::kSuccess) << task.progress().reason;
}

std::uint64_t TrialHash(Task& task, std::uint64_t seed, const std::vector<int>& plan) {
  task.Reset(seed);
  RunPlan(task, plan, nullptr);
  const std::vector<double> state = task.RobotState();
  const Image image = task.Observe();
  std::uint64_t hash = base::HashBytes(state.data(), state.size() * sizeof(double));
  return base::HashBytes(image.rgb.data(), image.rgb.size(), hash);
}

TEST(StackingTask, RepeatsBitForBitAlsoInThreads) {
  StackingTask task(TaskOptions{});
  const std::vector<int> plan = {3, 7, 11};
  const std::uint64_t hash = TrialHash(task, 3, plan);
  EXPECT_NE(TrialHash(task, 4, plan), hash);
  EXPECT_EQ(TrialHash(task, 3, plan), hash);
  std::uint64_t hashes[2] = {};
  std::vector<std::thread> threads;
  for (std::uint64_t& one : hashes) {
    threads.emplace_back([&one, &plan] {
      StackingTask own(TaskOptions{});
      one = TrialHash(own, 3, plan);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(hashes[0], hash);
  EXPECT_EQ(hashes[1], hash);
}

TEST(StackingTask, RepeatsInAnotherProcess) {
  const std::vector<int> plan = {2, 6, 10};
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    StackingTask task(TaskOptions{});
    const std::uint64_t hash = TrialHash(task, 7, plan);
    _exit(write(ends[1], &hash, sizeof hash) == sizeof hash ? 0 : 1);
  }
  std::uint64_t hash = 0;
  ASSERT_EQ(read(ends[0], &hash, sizeof hash), static_cast<ssize_t>(sizeof hash));
  waitpid(child, nullptr, 0);
  StackingTask task(TaskOptions{});
  EXPECT_EQ(hash, TrialHash(task, 7, plan));
}

TEST(StackingTask, WithoutExecutionNoiseASeedOfNoiseChangesNothing) {
  TaskOptions options;
  options.execution_noise = 0;
  StackingTask task(options);
  StackingTask noisy(TaskOptions{});
  EXPECT_NE(task.spec().world_version, noisy.spec().world_version);
  const auto end = [](StackingTask& one, std::uint64_t noise_seed) {
    one.Reset(3);
    one.SetNoiseSeed(noise_seed);
    RunPlan(one, {3, 7}, nullptr);
    return one.RobotState();
  };
  EXPECT_EQ(end(task, 1), end(task, 2));
  EXPECT_NE(end(noisy, 1), end(noisy, 2));
  options.execution_noise = -1;
  EXPECT_THROW(StackingTask{options}, std::invalid_argument);
}

TEST(StackingTask, GoesOnFromASavedStateInAnotherTask) {
  StackingTask task(TaskOptions{});
  task.Reset(5);
  RunPlan(task, {1, 5}, nullptr);
  const auto saved = task.Save();
  RunPlan(task, {9, 13}, nullptr);
  StackingTask other(TaskOptions{});
  other.Reset(6);
  other.Restore(*saved);
  RunPlan(other, {9, 13}, nullptr);
  EXPECT_EQ(other.RobotState(), task.RobotState());
  EXPECT_EQ(other.Observe().rgb, task.Observe().rgb);
  TaskOptions higher;
  higher.tower = 3;
  StackingTask stranger(higher);
  EXPECT_THROW(stranger.Restore(*saved), std::invalid_argument);
}

TEST(StackingTask, CamerasAndDepth) {
  StackingTask task(Quiet());
  task.ResetTo(OpenScene(), 1);
  EXPECT_THROW(task.RenderFrom("moon", 64, 64), std::invalid_argument);
  EXPECT_THROW(task.RenderFrom("view", 0, 64), std::invalid_argument);
  const Image view = task.RenderFrom("view", 96, 64);
  EXPECT_EQ(view.rgb.size(), 96u * 64 * 3);
  const DepthImage depth = task.ObserveDepth(64, 64);
  const std::set<int> seen(depth.body.begin(), depth.body.end());
  for (int block = 0; block < kBlocks; ++block) {
    EXPECT_TRUE(seen.count(ArmChain::kBodies + block)) << "block " << block;
  }
  for (std::size_t i = 0; i < depth.depth.size(); ++i) {
    if (depth.body[i] != DepthImage::kSky) {
      EXPECT_GT(depth.depth[i], 0.1f);
    }
  }
}

// The pixel at a block's landmark shows the block.
TEST(StackingTask, LandmarksAreWhereThePictureShowsThem) {
  StackingTask task(Quiet());
  task.ResetTo(OpenScene(), 1);
  const std::vector<Landmark> landmarks = task.Landmarks();
  ASSERT_EQ(landmarks.size(), task.spec().landmarks.size());
  const DepthImage seen = task.ObserveDepth(256, 256);
  for (int block = 0; block < 2; ++block) {
    const int x = static_cast<int>(landmarks[block].u * 256);
    const int y = static_cast<int>(landmarks[block].v * 256);
    EXPECT_EQ(seen.body.at(y * 256 + x), ArmChain::kBodies + block);
  }
}

}  // namespace
}  // namespace prospect::sim
