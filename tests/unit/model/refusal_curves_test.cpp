#include <gtest/gtest.h>

#include "model/refusal/isotonic.h"
#include "model/refusal/promise.h"
#include "model/refusal/risk_coverage.h"
#include "tests/unit/model/refusal_sample.h"

namespace prospect::model {
namespace {

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// --- success by score

CalibrationSample FiveAttempts() {
  return SampleOf({Scene(0.1, 's', 'F'), Scene(0.2, 's', 'S'), Scene(0.3, 's', 'T'),
                   Scene(0.4, 's', 'S'), Scene(0.5, 's', 'S'), Scene(0, 'h', 'R')});
}

TEST(SuccessCurve, PoolsNeighboursThatFall) {
  const SuccessCurve curve(FiveAttempts(), 1);
  ASSERT_EQ(curve.blocks().size(), 3u);
  EXPECT_EQ(curve.blocks()[0].share(), 0);
  EXPECT_EQ(curve.blocks()[1].share(), 0.5) << "0.2 was solved and 0.3 was not";
  EXPECT_EQ(curve.blocks()[1].low, 0.2);
  EXPECT_EQ(curve.blocks()[1].high, 0.3);
  EXPECT_EQ(curve.blocks()[2].share(), 1);
  EXPECT_EQ(curve.blocks()[2].scenes, 2);
}

TEST(SuccessCurve, AScoreBelongsToTheNearestBlock) {
  const SuccessCurve curve(FiveAttempts(), 1);
  EXPECT_EQ(curve.At(0).share(), 0);
  EXPECT_EQ(curve.At(0.14).share(), 0);
  EXPECT_EQ(curve.At(0.16).share(), 0.5);
  EXPECT_EQ(curve.At(0.34).share(), 0.5);
  EXPECT_EQ(curve.At(0.36).share(), 1);
  EXPECT_EQ(curve.At(1).share(), 1);
}

TEST(SuccessCurve, SmallBlocksJoinTheNearerNeighbour) {
  const SuccessCurve two(FiveAttempts(), 2);
  ASSERT_EQ(two.blocks().size(), 2u);
  EXPECT_DOUBLE_EQ(two.blocks()[0].share(), 1.0 / 3);
  EXPECT_EQ(two.blocks()[1].share(), 1);
  const SuccessCurve one(FiveAttempts(), 100);
  ASSERT_EQ(one.blocks().size(), 1u);
  EXPECT_DOUBLE_EQ(one.blocks()[0].share(), 0.6);
}

TEST(SuccessCurve, PoolsBackwardsAsFarAsNeeded) {
  // 0.2 and 0.3 rise; the two failures above them pull all down to 2 of 4.
  const SuccessCurve curve(
      SampleOf({Scene(0.1, 's', 'F'), Scene(0.2, 's', 'S'), Scene(0.3, 's', 'S'),
                Scene(0.4, 's', 'F'), Scene(0.5, 's', 'F')}),
      1);
  ASSERT_EQ(curve.blocks().size(), 2u);
  EXPECT_EQ(curve.blocks()[1].scenes, 4);
  EXPECT_EQ(curve.blocks()[1].solved, 2);
}

TEST(SuccessCurve, OfNothingIsEmpty) {
  EXPECT_TRUE(SuccessCurve(SampleOf({Scene(0, 'h', 'R')})).empty());
}

// --- risk and coverage

CalibrationSample FourScenes() {
  return SampleOf(
      {Scene(0.9, 's', 'S'), Scene(0.8, 'd', 'F'), Scene(0.5, 's', 'S'), Scene(0, 'h', 'R')});
}

TEST(RiskCoverage, CountsWhatEachThresholdLetsThrough) {
  const auto curve = RiskCoverageCurve(FourScenes());
  ASSERT_EQ(curve.size(), 3u);
  EXPECT_DOUBLE_EQ(curve[0].coverage, 0.25);
  EXPECT_DOUBLE_EQ(curve[0].risk, 0);
  EXPECT_DOUBLE_EQ(curve[1].coverage, 0.5);
  EXPECT_DOUBLE_EQ(curve[1].risk, 0.5);
  EXPECT_DOUBLE_EQ(curve[2].coverage, 0.75);
  EXPECT_DOUBLE_EQ(curve[2].risk, 1.0 / 3);
  EXPECT_EQ(curve[1].refused_solvable, 1);
  EXPECT_EQ(curve[1].refused_hopeless, 1);
  EXPECT_EQ(curve[2].solved, 2);
}

TEST(RiskCoverage, AreaAndCoverageAtARisk) {
  const auto curve = RiskCoverageCurve(FourScenes());
  // (0.25 * (0 + 1/2) / 2 + 0.25 * (1/2 + 1/3) / 2) / 0.5
  EXPECT_NEAR(AreaUnder(curve), 1.0 / 3, 1e-12);
  EXPECT_DOUBLE_EQ(CoverageAtRisk(curve, 0.1), 0.25);
  EXPECT_DOUBLE_EQ(CoverageAtRisk(curve, 0.4), 0.75) << "beyond a stretch of more risk";
  EXPECT_EQ(CoverageAtRisk({}, 0.4), 0);
  EXPECT_EQ(AreaUnder({}), 0);
}

TEST(RiskCoverage, NothingAttemptedIsNoRisk) {
  const ThresholdEffect effect = EffectOf(FourScenes(), 0.95);
  EXPECT_EQ(effect.attempted, 0);
  EXPECT_EQ(effect.risk, 0);
}

TEST(Auroc, CountsPairsAndHalfOfTies) {
  const CalibrationSample sample =
      SampleOf({Scene(0.9, 's', 'S'), Scene(0.5, 's', 'F'), Scene(0.5, 'h', 'F'),
                Scene(0.7, 'h', 'R'), Scene(0.99, 'd', 'F')});
  EXPECT_DOUBLE_EQ(SolvabilityAuroc(sample), 3.5 / 4) << "a scene without a plan scores least";
  EXPECT_EQ(SolvabilityAuroc(SampleOf({Scene(0.9, 's', 'S')})), -1);
}

// --- promises

// Solved ones score 0.5 to 0.798, failed ones of solvable scenes 0.3 to 0.398.
CalibrationSample Many() {
  std::vector<CalibrationScene> scenes;
  for (int i = 0; i < 150; ++i) scenes.push_back(Scene(0.5 + 0.002 * i, 's', 'S'));
  for (int i = 0; i < 50; ++i) scenes.push_back(Scene(0.3 + 0.002 * i, 's', 'F'));
  return SampleOf(scenes);
}

TEST(Promise, OneBoundIsTheThreshold) {
  const CalibrationSample sample = Many();
  Promise promise;
  promise.refuse_at_most = 0.05;
  PromisedThreshold t = ThresholdFor(sample, promise);
  EXPECT_TRUE(t.kept && t.may_attempt);
  EXPECT_DOUBLE_EQ(t.value, RefuseAtMost(sample, 0.05).value);
  EXPECT_TRUE(Holds(t.words.at(0), "Refuses at most 5 % of what can be done")) << t.words[0];
  EXPECT_TRUE(Holds(t.words.at(0), "9 of 200 solvable")) << t.words[0];
  promise = {std::nullopt, 0.1, 0.1};
  t = ThresholdFor(sample, promise);
  EXPECT_TRUE(t.kept && t.may_attempt);
  EXPECT_DOUBLE_EQ(t.value, FailAtMost(sample, 0.1, 0.1).value);
  EXPECT_TRUE(
      Holds(t.words.at(0), "Fails at most 10 % of what is attempted (with confidence 90 %)"))
      << t.words[0];
}

TEST(Promise, WhereBothHoldTheThresholdThatFailsLeastIsTaken) {
  const CalibrationSample sample = Many();
  const PromisedThreshold t = ThresholdFor(sample, {0.3, 0.1, 0.1});
  EXPECT_TRUE(t.kept);
  EXPECT_GT(t.refuse.value, t.fail.value);
  EXPECT_EQ(t.value, t.refuse.value);
  EXPECT_EQ(t.words.size(), 2u);
}

TEST(Promise, WhereBothCannotBeHadFailingSeldomHolds) {
  const CalibrationSample sample = Many();
  const PromisedThreshold t = ThresholdFor(sample, {0.05, 0.1, 0.1});
  EXPECT_FALSE(t.kept);
  EXPECT_TRUE(t.may_attempt);
  EXPECT_EQ(t.value, t.fail.value);
  ASSERT_EQ(t.words.size(), 3u);
  EXPECT_TRUE(Holds(t.words[2], "Both cannot be had")) << t.words[2];
}

TEST(Promise, WhatNothingPromisesForbidsEveryAttempt) {
  const PromisedThreshold t = ThresholdFor(Many(), {std::nullopt, 0.001, 0.1});
  EXPECT_FALSE(t.may_attempt);
  EXPECT_FALSE(t.kept);
  EXPECT_TRUE(Holds(t.words.at(0), "cannot be promised")) << t.words[0];
}

TEST(Promise, TooFewSolvableScenesAreNamed) {
  const PromisedThreshold t = ThresholdFor(Many(), {0.001, std::nullopt, 0.1});
  EXPECT_FALSE(t.kept);
  EXPECT_EQ(t.value, 0);
  EXPECT_TRUE(Holds(t.words.at(0), "more are needed")) << t.words[0];
}

TEST(Promise, DifferencesNameWhatIsNotCovered) {
  CalibrationSample sample;
  sample.rule = "paper";
  sample.parameters = {{"samples", 30}, {"v_failed", 0.1}, {"only_here", 1}};
  EXPECT_TRUE(Differences(sample, "paper", {{"samples", 30}, {"only_there", 2}}).empty());
  const auto words = Differences(sample, "puct", {{"samples", 10}, {"v_failed", 0.1}});
  ASSERT_EQ(words.size(), 2u);
  EXPECT_EQ(words[0], "rule puct instead of paper");
  EXPECT_EQ(words[1], "samples 10 instead of 30");
}

TEST(CurveTable, GoesFromAllToTheStrictest) {
  const std::string table = CurveTable(Many(), 5);
  EXPECT_TRUE(Holds(table, "     0.000     100.0 %      75.0 %      25.0 %")) << table;
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2 + 5) << table;
}

}  // namespace
}  // namespace prospect::model
