#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "sim/rollout.h"
#include "sim/task_factory.h"
#include "tools/evaluate/plan_outcomes.h"
#include "tools/evaluate/plan_scores.h"

namespace prospect::tools {
namespace {

using nlohmann::json;
using planner::Path;

json Plan(double frequency, double again, std::vector<double> score) {
  return {{"plan", {0}}, {"frequency", frequency}, {"again", again}, {"score", score}};
}

json Scene(std::uint64_t seed, std::vector<json> plans) {
  return {{"seed", seed}, {"plans", plans}, {"pictures", json::array()}};
}

TEST(RankCorrelation, IsOfRanksAndSharesThemAmongEquals) {
  EXPECT_DOUBLE_EQ(RankCorrelation({1, 2, 3, 4}, {0.1, 10, 11, 1000}), 1);
  EXPECT_DOUBLE_EQ(RankCorrelation({1, 2, 3, 4}, {4, 3, 2, 1}), -1);
  // By hand: ranks (0, 1.5, 1.5, 3) and (0, 1, 2, 3).
  EXPECT_NEAR(RankCorrelation({1, 2, 2, 3}, {1, 2, 3, 4}), 4.5 / std::sqrt(4.5 * 5.0), 1e-12);
  EXPECT_TRUE(std::isnan(RankCorrelation({1, 1, 1}, {1, 2, 3})));
}

TEST(Plans, FiguresTellAGoodJudgeFromABadOne) {
  const std::vector<PlanScene> scenes = {
      Scene(1, {Plan(1, 1, {0.9, 0.9}), Plan(0, 0, {0.8, 0.1}), Plan(0.5, 0.6, {0.7, 0.5})}),
      Scene(2, {Plan(0, 0.1, {0.1, 0.2}), Plan(0, 0, {0.2, 0.1})})};
  const json summary = SummarisePlans(scenes);
  EXPECT_EQ(summary["scenes"], 2);
  EXPECT_EQ(summary["plans"], 5);
  EXPECT_EQ(summary["scenes_with_spread"], 1);
  EXPECT_DOUBLE_EQ(summary["ranking"]["rho"]["value"], 1);
  EXPECT_DOUBLE_EQ(summary["ranking"]["auroc"]["value"], 1);
  EXPECT_DOUBLE_EQ(summary["ceiling"]["auroc"]["value"], 1);
  // After one action the order is 0.9, 0.8, 0.7 for frequencies 1, 0, 0.5.
  EXPECT_DOUBLE_EQ(summary["by_depth"][0]["rho"]["value"], 0.5);
  EXPECT_LT(summary["by_depth"][0]["auroc"]["value"], 1);
}

TEST(Plans, OneScoreForAllPlansIsNoRanking) {
  const json summary =
      SummarisePlans({Scene(1, {Plan(1, 1, {0.5}), Plan(0, 0, {0.5}), Plan(0, 0, {0.5})})});
  EXPECT_DOUBLE_EQ(summary["ranking"]["rho"]["value"], 0);
  EXPECT_DOUBLE_EQ(summary["ranking"]["auroc"]["value"], 0.5);
}

TEST(Plans, OfNavigationAreAllOrdersOfWhatIsThere) {
  const auto task = sim::MakeTask("navigation", {});
  task->Reset(1'000'000);
  EXPECT_EQ(LegalPlans(*task, 1, 100).size(), 24u);
  const auto few = LegalPlans(*task, 1, 5);
  EXPECT_EQ(few.size(), 5u);
  EXPECT_EQ(few, LegalPlans(*task, 1, 5));
  EXPECT_NE(few, LegalPlans(*task, 2, 5));
}

// Carried out together, with their beginnings shared, plans fare as each does alone.
TEST(Plans, ShareTheirBeginnings) {
  constexpr std::uint64_t kSeed = 1'000'000;
  constexpr int kRuns = 1;
  const auto task = sim::MakeTask("navigation", {});
  task->Reset(kSeed);
  const auto plans = LegalPlans(*task, kSeed, 12);
  const auto together = CarryOut(*task, kSeed, plans, kRuns);
  ASSERT_EQ(together.size(), plans.size());
  int successes = 0;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const auto alone = CarryOut(*task, kSeed, {plans[i]}, kRuns);
    EXPECT_EQ(together[i].successes, alone[0].successes) << planner::ToString(plans[i]);
    EXPECT_EQ(together[i].again, alone[0].again) << planner::ToString(plans[i]);
    successes += together[i].successes;
    task->Reset(kSeed);
    const std::vector<int> actions(plans[i].begin(), plans[i].end());
    const bool works = sim::RunPlan(*task, actions, nullptr).outcome == sim::Outcome::kSuccess;
    if (together[i].successes + together[i].again == 2 * kRuns) {
      EXPECT_TRUE(works);
    }
    task->Reset(kSeed);
  }
  EXPECT_GT(successes, 0);
  EXPECT_LT(successes, kRuns * static_cast<int>(plans.size()));
}

TEST(OutcomeFile, KeepsScenesAndSkipsWhatWasCutShort) {
  const std::string path = testing::TempDir() + "/plans/outcomes.jsonl";
  std::remove(path.c_str());
  OutcomeFile(path).Store(5, {{{1, 2}, 3, 4}});
  std::ofstream(path, std::ios::app) << "{\"seed\": 6, \"plans\": [[[1],";
  const OutcomeFile again(path);
  ASSERT_NE(again.Find(5), nullptr);
  EXPECT_EQ(again.Find(5)->at(0).plan, (Path{1, 2}));
  EXPECT_EQ(again.Find(5)->at(0).successes, 3);
  EXPECT_EQ(again.Find(5)->at(0).again, 4);
  EXPECT_EQ(again.Find(6), nullptr);
}

TEST(OutcomeFile, MayLieWhereOneIs) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(testing::TempDir());
  OutcomeFile("here.jsonl").Store(5, {{{1, 2}, 3, 4}});
  EXPECT_TRUE(std::filesystem::remove("here.jsonl"));
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace prospect::tools
