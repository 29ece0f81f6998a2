#include "services/executive/policy.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace prospect::services {
namespace {

TEST(PolicyTest, KnownOnesAndMistakes) {
  EXPECT_EQ(PolicyDefect("search"), "");
  EXPECT_EQ(PolicyDefect("collect"), "");
  EXPECT_EQ(PolicyDefect("plan:0,2,1"), "");
  for (const char* wrong : {"", "plan:", "plan:a", "plan:1;2", "plan:-1", "dance"}) {
    EXPECT_NE(PolicyDefect(wrong), "") << wrong;
  }
  EXPECT_EQ(ParsePlan("plan:0,12,1"), (std::vector<int>{0, 12, 1}));
}

task_t FreeTask(int actions, int plan_length) {
  task_t task{};
  task.num_actions = actions;
  task.plan_length = plan_length;
  std::vector<std::int32_t> all;
  for (int i = 0; i < actions; ++i) all.push_back(i);
  for (int i = 0; i < actions; ++i) {
    action_t action{};
    action.index = i;
    action.successors = all;
    task.actions.push_back(action);
  }
  task.initial = all;
  return task;
}

TEST(PolicyTest, CollectPlanIsLegalPresentAndDecidedByTheSeed) {
  label_t label{};
  label.present = {1, 0, 1, 1, 0, 1};
  std::set<std::vector<int>> plans;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto plan = CollectPlan(FreeTask(6, 3), label, seed);
    ASSERT_EQ(plan.size(), 3u);
    EXPECT_EQ(std::set<int>(plan.begin(), plan.end()).size(), 3u);
    for (const int action : plan) EXPECT_EQ(label.present[static_cast<std::size_t>(action)], 1);
    EXPECT_EQ(CollectPlan(FreeTask(6, 3), label, seed), plan);
    plans.insert(plan);
  }
  EXPECT_GT(plans.size(), 10u);
}

// A task of three steps whose second may be followed by a new beginning: 0 or 1, then 2, then 3.
TEST(PolicyTest, ExpertNeverTriesAgainAndCollectSometimes) {
  task_t task = FreeTask(4, 3);
  task.repeats_allowed = 1;
  task.initial = {0, 1};
  task.num_initial = 2;
  const std::vector<std::vector<int>> successors = {{2}, {2}, {0, 1, 3}, {0, 1}};
  for (std::size_t i = 0; i < successors.size(); ++i) {
    task.actions[i].successors.assign(successors[i].begin(), successors[i].end());
    task.actions[i].num_successors = static_cast<std::int32_t>(successors[i].size());
  }
  label_t label{};
  label.present = {1, 1, 1, 1};
  label.num_present = 4;
  int longer = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    EXPECT_EQ(CollectPlan(task, label, seed, false).size(), 3u);
    const auto plan = CollectPlan(task, label, seed);
    EXPECT_EQ(plan.back(), 3);
    longer += plan.size() == 5;
  }
  EXPECT_GT(longer, 5);
  EXPECT_LT(longer, 60);
}

// A robot that says no LABEL.
TEST(PolicyTest, WithoutALabelEveryActionMayBeTried) {
  std::set<int> tried;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto plan = CollectPlan(FreeTask(6, 3), std::nullopt, seed);
    ASSERT_EQ(plan.size(), 3u);
    tried.insert(plan.begin(), plan.end());
  }
  EXPECT_EQ(tried.size(), 6u);
}

TEST(PolicyTest, LabelsOfAnotherTableAreNamed) {
  label_t label{};
  label.present = {1, 1};
  EXPECT_THROW(CollectPlan(FreeTask(6, 3), label, 1), std::invalid_argument);
}

}  // namespace
}  // namespace prospect::services
