#include "sim/rollout.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/sim/scripted_task.h"

namespace prospect::sim {
namespace {

struct Recorder : FrameSink {
  void OnFrame(const Image&, const Progress& progress) override { frames.push_back(progress); }
  std::vector<Progress> frames;
};

std::string Never(const std::vector<int>&, std::uint64_t) { return ""; }

TEST(Rollout, GivesEveryFrameWithItsLabel) {
  ScriptedTask task(Never);
  Recorder recorder;
  const RolloutResult result = RunPlan(task, {3, 1, 2}, &recorder);
  EXPECT_EQ(result.outcome, Outcome::kSuccess);
  EXPECT_EQ(result.ticks, 6);
  std::vector<int> actions, segments;
  for (const Progress& frame : recorder.frames) {
    actions.push_back(frame.action);
    segments.push_back(frame.segment);
  }
  EXPECT_EQ(actions, (std::vector<int>{4, 3, 3, 1, 1, 2, 2}));
  EXPECT_EQ(segments, (std::vector<int>{-1, 0, 0, 1, 1, 2, 2}));
  EXPECT_EQ(recorder.frames[2].action_state, ActionState::kSucceeded);
  EXPECT_EQ(recorder.frames[6].outcome, Outcome::kSuccess);
}

TEST(Rollout, EndsWithTheTrial) {
  ScriptedTask task(
      [](const std::vector<int>& path, std::uint64_t) { return path.size() == 2 ? "broke" : ""; });
  const RolloutResult result = RunPlan(task, {3, 1, 2}, nullptr);
  EXPECT_EQ(result.outcome, Outcome::kFailure);
  EXPECT_EQ(result.reason, "broke");
  EXPECT_EQ(result.actions_done, 1);
  EXPECT_EQ(result.ticks, 4);
}

TEST(Rollout, ReportsARefusedStep) {
  ScriptedTask task(Never);
  const RolloutResult result = RunPlan(task, {3, 3}, nullptr);
  EXPECT_EQ(result.outcome, Outcome::kRunning);
  EXPECT_EQ(result.reason, "illegal_action");
  EXPECT_EQ(result.actions_done, 1);
}

}  // namespace
}  // namespace prospect::sim
