#include "tools/evaluate/recovery.h"

#include <gtest/gtest.h>

#include "sim/rollout.h"
#include "sim/stacking/action_table.h"
#include "sim/task_factory.h"

namespace prospect::tools {
namespace {

constexpr std::uint64_t kFirstScene = 1'400'000;  // tuning scenes: never in a reported figure
constexpr int kBlocks = 4;

int Action(sim::StackingKind kind, int block) { return sim::StackingIndex(kind, block, kBlocks); }

// Red on green, up to where the gripper has let go.
bool PutDown(sim::Task* task, std::uint64_t seed) {
  using Kind = sim::StackingKind;
  task->Reset(seed);
  for (const auto& [kind, block] : {std::pair{Kind::kAlign, 0},
                                    {Kind::kGrasp, 0},
                                    {Kind::kClose, 0},
                                    {Kind::kLift, 0},
                                    {Kind::kAlignOver, 1},
                                    {Kind::kStack, 1},
                                    {Kind::kOpen, 1}}) {
    if (!sim::RunAction(*task, Action(kind, block), nullptr)) return false;
  }
  return task->progress().outcome == sim::Outcome::kRunning;
}

// Steady hands put a block down where it stays: nothing is lost.
TEST(ConsultRecovery, SaysNothingOfATowerThatStands) {
  sim::TaskOptions options;
  options.execution_noise = 0;
  const auto task = sim::MakeTask("stacking", options);
  int standing = 0;
  for (std::uint64_t seed = kFirstScene; seed < kFirstScene + 20 && standing < 2; ++seed) {
    if (!PutDown(task.get(), seed)) continue;
    ++standing;
    EXPECT_FALSE(ConsultRecovery(*task, seed)) << seed;
  }
  EXPECT_EQ(standing, 2);
}

// Rough hands drop it.
TEST(ConsultRecovery, SpeaksOfALostPlanAndLeavesTheWorldAsItWas) {
  sim::TaskOptions options;
  options.execution_noise = 4;
  const auto task = sim::MakeTask("stacking", options);
  std::uint64_t seed = kFirstScene;
  while (seed < kFirstScene + 40 && !(PutDown(task.get(), seed) && ConsultRecovery(*task, seed)))
    ++seed;
  ASSERT_LT(seed, kFirstScene + 40) << "no block was dropped";
  const double before = task->progress().time;
  const std::vector<double> state = task->RobotState();
  const auto recovery = ConsultRecovery(*task, seed);
  ASSERT_TRUE(recovery);
  EXPECT_DOUBLE_EQ(recovery->time, before);
  EXPECT_EQ(task->progress().time, before);
  EXPECT_EQ(task->RobotState(), state);
}

TEST(ConsultRecovery, SaysNothingWhereNothingCanBeBegunAnew) {
  const auto task = sim::MakeTask("stacking");
  task->Reset(kFirstScene);
  EXPECT_FALSE(ConsultRecovery(*task, kFirstScene));
  sim::RunAction(*task, Action(sim::StackingKind::kAlign, 0), nullptr);
  EXPECT_FALSE(ConsultRecovery(*task, kFirstScene));
  const auto site = sim::MakeTask("navigation");
  site->Reset(kFirstScene);
  sim::RunAction(*site, site->LegalActions().front(), nullptr);
  EXPECT_FALSE(ConsultRecovery(*site, kFirstScene));
}

}  // namespace
}  // namespace prospect::tools
