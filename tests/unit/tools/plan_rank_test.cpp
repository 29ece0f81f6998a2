#include "tools/evaluate/plan_rank.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/dataset.h"
#include "model/scripted_engine.h"
#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::tools {
namespace {

using model::Hidden;
using planner::Path;

constexpr int kSize = 32;

model::ScriptedEngine MadeEngine() {
  model::ScriptedOptions options;
  options.task = "made";
  options.num_actions = 3;
  options.offered_actions = 3;
  options.failing_share = 0;
  options.image_width = options.image_height = kSize;
  return model::ScriptedEngine(options);
}

class PlanRankTest : public testing::Test {
 protected:
  std::vector<PlanRank> RanksOf(const model::Trial& trial, int most) {
    const std::string one = folder_ / "one.h5", all = folder_ / "all.h5";
    model::WriteTrialFile(one, trial);
    model::PackTrialFiles({one}, all);
    return RankPlans(engine_, model::TrialFile(all), {0}, planner::AnyOrder(3, 2), most);
  }

  double ScoreOf(const model::Trial& trial, const Path& path) {
    const Hidden h0 = engine_.Encode(model::Pixels(trial.frame(0), trial.frame_bytes()));
    Hidden h = h0;
    double score = 1, value = 0;
    for (const int action : path) {
      const model::Prediction next = engine_.Expand({{h0, h, action}}).front();
      h = next.h;
      score *= next.done;
      value = next.value;
    }
    return score * value;
  }

  model::TestFolder folder_;
  model::ScriptedEngine engine_ = MadeEngine();
};

// Of three actions, each done once, there are six plans of two.
TEST_F(PlanRankTest, APlanStandsAmongAllOthersOfItsScene) {
  const model::Trial trial = model::MadeTrial(5, 2, false, 4, kSize);  // actions 2 and 0
  const double own = ScoreOf(trial, {2, 0});
  int less = 0;
  for (const Path& other : {Path{0, 1}, Path{0, 2}, Path{1, 0}, Path{1, 2}, Path{2, 1}})
    less += ScoreOf(trial, other) < own;
  const std::vector<PlanRank> ranks = RanksOf(trial, 50);
  ASSERT_EQ(ranks.size(), 1U);
  EXPECT_TRUE(ranks[0].succeeded);
  EXPECT_EQ(ranks[0].others, 5);
  EXPECT_DOUBLE_EQ(ranks[0].above, less / 5.0);
}

TEST_F(PlanRankTest, WhatFailedEarlyStandsAmongBeginnings) {
  const std::vector<PlanRank> ranks = RanksOf(model::MadeTrial(5, 1, true, 4, kSize), 50);
  ASSERT_EQ(ranks.size(), 1U);
  EXPECT_FALSE(ranks[0].succeeded);
  EXPECT_EQ(ranks[0].others, 2);
}

TEST_F(PlanRankTest, ActionsWhoseObjectIsNotThereAreNotDrawn) {
  model::Trial trial = model::MadeTrial(5, 2, false, 4, kSize);
  trial.present = {1, 0, 1};
  EXPECT_EQ(RanksOf(trial, 50).at(0).others, 1);  // 0 and 2 the other way round
}

TEST_F(PlanRankTest, NoMoreAreDrawnThanWereAskedFor) {
  EXPECT_EQ(RanksOf(model::MadeTrial(5, 2, false, 4, kSize), 3).at(0).others, 3);
}

TEST_F(PlanRankTest, WhatTheRulesDoNotAllowIsLeftOut) {
  EXPECT_TRUE(RanksOf(model::MadeTrial(5, 3, false, 4, kSize), 50).empty());
}

TEST(PlanRankReport, TellsThemApart) {
  const nlohmann::json report = ReportOf({{true, 5, 1}, {true, 5, 0.8}, {false, 2, 0.5}});
  EXPECT_EQ(report["succeeded"]["trials"], 2);
  EXPECT_DOUBLE_EQ(report["succeeded"]["above"], 0.9);
  EXPECT_DOUBLE_EQ(report["others"], 4);
  EXPECT_NE(
      RankWords(report).find("one that succeeded scores above 90 %, one that failed above 50"),
      std::string::npos)
      << RankWords(report);
  EXPECT_TRUE(ReportOf({})["failed"]["above"].is_null());
  EXPECT_NE(RankWords(ReportOf({})).find("No recorded plan"), std::string::npos);
}

}  // namespace
}  // namespace prospect::tools
