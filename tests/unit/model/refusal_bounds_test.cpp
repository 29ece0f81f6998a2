#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/refusal/binomial.h"
#include "model/refusal/conformal.h"
#include "tests/unit/model/refusal_sample.h"

namespace prospect::model {
namespace {

// Solvable scenes that score 0.05, 0.10, ... and are all solved.
CalibrationSample Ladder(int n) {
  std::vector<CalibrationScene> scenes;
  for (int i = 1; i <= n; ++i) scenes.push_back(Scene(i * 0.05, 's', 'S'));
  return SampleOf(scenes);
}

TEST(Binomial, SumsOfItsTerms) {
  EXPECT_NEAR(BinomialAtMost(1, 3, 0.5), 4.0 / 8, 1e-12);
  EXPECT_NEAR(BinomialAtMost(0, 22, 0.1), std::pow(0.9, 22), 1e-12);
  EXPECT_NEAR(BinomialAtMost(1, 23, 0.1), std::pow(0.9, 23) + 23 * 0.1 * std::pow(0.9, 22), 1e-12);
  EXPECT_EQ(BinomialAtMost(-1, 5, 0.3), 0);
  EXPECT_EQ(BinomialAtMost(5, 5, 0.3), 1);
  EXPECT_EQ(BinomialAtMost(2, 5, 0), 1);
  EXPECT_EQ(BinomialAtMost(2, 5, 1), 0);
}

TEST(BetaBinomial, WithAUniformShareEveryCountIsAsLikely) {
  for (int k = 0; k < 40; ++k) EXPECT_NEAR(BetaBinomialAtMost(k, 40, 1, 1), (k + 1) / 41.0, 1e-9);
  const CountBand band = BetaBinomialBand(40, 1, 1, 0.95);
  EXPECT_EQ(band.low, 1) << "0 has a chance of 1 in 41, which may lie beyond";
  EXPECT_EQ(band.high, 39);
  EXPECT_TRUE(band.Holds(1) && band.Holds(39) && !band.Holds(0) && !band.Holds(40));
  const CountBand all = BetaBinomialBand(38, 1, 1, 0.95);
  EXPECT_TRUE(all.Holds(0) && all.Holds(38)) << "each has a chance of 1 in 39, which is too much";
}

TEST(BetaBinomial, IsBinomialWhereTheShareIsKnown) {
  EXPECT_NEAR(BetaBinomialAtMost(3, 20, 1e7, 9e7), BinomialAtMost(3, 20, 0.1), 1e-5);
}

TEST(BinomialBand, BeginsAtZero) {
  // P(X <= 4) = 0.957, P(X <= 5) = 0.989 for 20 at a tenth.
  const CountBand band = BinomialBandFromZero(20, 0.1, 0.95);
  EXPECT_EQ(band.low, 0);
  EXPECT_EQ(band.high, 5);
}

TEST(RefuseAtMost, IsTheKthSmallestSolvableScore) {
  const ThresholdBound bound = RefuseAtMost(Ladder(19), 0.1);  // k = 0.1 * 20 = 2
  EXPECT_TRUE(bound.kept);
  EXPECT_DOUBLE_EQ(bound.value, 0.10);
  EXPECT_EQ(bound.scenes, 19);
  EXPECT_EQ(bound.count, 1) << "only what scores less is refused";
}

TEST(RefuseAtMost, LooksAtSolvableScenesAlone) {
  CalibrationSample sample = Ladder(19);
  for (const char scene_class : {'h', 'd'})
    sample.scenes.insert(sample.scenes.begin(), Scene(0.01, scene_class, 'F'));
  EXPECT_DOUBLE_EQ(RefuseAtMost(sample, 0.1).value, 0.10);
}

TEST(RefuseAtMost, ScenesWithoutAPlanAreRefusedAnyway) {
  CalibrationSample sample = Ladder(18);
  sample.scenes.push_back(Scene(0, 's', 'R'));
  const ThresholdBound bound = RefuseAtMost(sample, 0.1);
  EXPECT_TRUE(bound.kept);
  EXPECT_DOUBLE_EQ(bound.value, 0.05);
  EXPECT_EQ(bound.count, 1);
  sample.scenes[0] = Scene(0, 's', 'R');
  EXPECT_FALSE(RefuseAtMost(sample, 0.1).kept) << "two are refused whatever the threshold";
  EXPECT_EQ(RefuseAtMost(sample, 0.1).value, 0);
}

TEST(RefuseAtMost, TooFewScenesPromiseNothing) {
  EXPECT_FALSE(RefuseAtMost(Ladder(18), 0.05).kept);  // k = floor(0.95)
  EXPECT_TRUE(RefuseAtMost(Ladder(19), 0.05).kept);   // k = 1, in spite of rounding
  EXPECT_FALSE(RefuseAtMost({}, 0.5).kept);
}

// New scenes are refused in k / (n + 1) of all cases, on average over samples.
TEST(RefuseAtMost, KeepsItsPromiseOverManySamples) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> score(0, 1);
  constexpr int kSamples = 4000, kScenes = 59;
  double refused = 0;
  for (int i = 0; i < kSamples; ++i) {
    std::vector<CalibrationScene> scenes;
    for (int j = 0; j < kScenes; ++j) scenes.push_back(Scene(score(random), 's', 'S'));
    refused += RefuseAtMost(SampleOf(scenes), 0.1).value;  // the share of uniform scores below it
  }
  EXPECT_NEAR(refused / kSamples, 6.0 / 60, 0.003);  // four standard errors: 0.0024
}

TEST(FirstTested, IsNoMoreThanHalfUnlessFewerCannotPass) {
  EXPECT_EQ(FirstTested(40, 0.1, 0.1), 22) << "0.9^22 is the first power below 0.1";
  EXPECT_EQ(FirstTested(60, 0.1, 0.1), 30);
  const int enough = FirstTested(100000, 0.1, 0.1);
  EXPECT_GT(enough, 60);
  EXPECT_LT(enough, 300);
}

// `good` solved ones of high score above `bad` failed ones.
CalibrationSample GoodAboveBad(int good, int bad) {
  std::vector<CalibrationScene> scenes;
  for (int i = 0; i < good; ++i) scenes.push_back(Scene(0.9 - 0.001 * i, 's', 'S'));
  for (int i = 0; i < bad; ++i) scenes.push_back(Scene(0.4 - 0.001 * i, 'h', 'F'));
  return SampleOf(scenes);
}

TEST(FailAtMost, StopsAtTheFirstTestThatIsNotPassed) {
  // With 22 of 22 solved p is 0.0985; with 23 and one failure it is 0.315.
  const ThresholdBound bound = FailAtMost(GoodAboveBad(22, 18), 0.1, 0.2);
  EXPECT_TRUE(bound.kept);
  EXPECT_DOUBLE_EQ(bound.value, 0.9 - 0.021);
  EXPECT_EQ(bound.scenes, 22);
  EXPECT_EQ(bound.count, 0);
  EXPECT_FALSE(FailAtMost(GoodAboveBad(21, 19), 0.1, 0.2).kept);
}

TEST(FailAtMost, WhereEverythingPassesNothingIsRefused) {
  const ThresholdBound bound = FailAtMost(GoodAboveBad(60, 0), 0.1, 0.2);
  EXPECT_TRUE(bound.kept);
  EXPECT_EQ(bound.value, 0);
  EXPECT_EQ(bound.scenes, 60);
}

// The twenty best scores fail, and nothing else: no order of scores is passed, but all together
// are.
TEST(FailAtMost, ScoresThatDoNotRankWhatFailsAreTestedAsAWhole) {
  std::vector<CalibrationScene> scenes;
  for (int i = 0; i < 200; ++i) scenes.push_back(Scene(0.9 - 0.001 * i, 's', i < 20 ? 'F' : 'S'));
  const ThresholdBound bound = FailAtMost(SampleOf(scenes), 0.2, 0.1);
  EXPECT_TRUE(bound.kept);
  EXPECT_EQ(bound.value, 0);
  EXPECT_EQ(bound.scenes, 200);
  EXPECT_EQ(bound.count, 20);
  EXPECT_FALSE(FailAtMost(SampleOf(scenes), 0.12, 0.1).kept);  // p = 0.22
}

TEST(FailAtMost, MoreConfidenceTakesMoreScenes) {
  EXPECT_TRUE(FailAtMost(GoodAboveBad(28, 12), 0.1, 0.2).kept);
  EXPECT_FALSE(FailAtMost(GoodAboveBad(28, 12), 0.1, 0.1).kept);  // 0.9^28 = 0.0523
  EXPECT_TRUE(FailAtMost(GoodAboveBad(29, 12), 0.1, 0.1).kept);
}

TEST(FailAtMost, StoppedIsNoFailureAndRefusedNoAttempt) {
  CalibrationSample sample = GoodAboveBad(22, 18);
  for (auto& scene : sample.scenes) {
    if (scene.ending == SceneEnding::kFailed) scene.ending = SceneEnding::kStopped;
  }
  EXPECT_EQ(FailAtMost(sample, 0.1, 0.2).scenes, 40);
  for (auto& scene : sample.scenes) {
    if (scene.ending == SceneEnding::kStopped) scene.ending = SceneEnding::kRefused;
  }
  EXPECT_EQ(FailAtMost(sample, 0.1, 0.2).scenes, 22);
}

TEST(FailAtMost, EqualScoresAreAttemptedTogether) {
  std::vector<CalibrationScene> scenes;
  for (int i = 0; i < 30; ++i) scenes.push_back(Scene(0.9, 's', 'S'));
  for (int i = 0; i < 3; ++i) scenes.push_back(Scene(0.9, 's', 'F'));
  scenes.push_back(Scene(0.2, 's', 'F'));
  EXPECT_FALSE(FailAtMost(SampleOf(scenes), 0.1, 0.2).kept);  // 3 of 33: p = 0.57
}

// Scores are uniform, and a scene of score s fails with probability 0.4 (1 - s): above a threshold
// t the share is 0.2 (1 - t), so below t = 0.5 the promise of 0.1 is broken.
TEST(FailAtMost, BreaksItsPromiseInAtMostDeltaOfAllSamples) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int kSamples = 500, kScenes = 600;
  int broken = 0, kept = 0;
  for (int i = 0; i < kSamples; ++i) {
    std::vector<CalibrationScene> scenes;
    for (int j = 0; j < kScenes; ++j) {
      const double score = unit(random);
      scenes.push_back(Scene(score, 's', unit(random) < 0.4 * (1 - score) ? 'F' : 'S'));
    }
    const ThresholdBound bound = FailAtMost(SampleOf(scenes), 0.1, 0.1);
    kept += bound.kept;
    broken += bound.kept && bound.value < 0.5;
  }
  EXPECT_LE(broken, kSamples * 0.1 + 3 * std::sqrt(kSamples * 0.1 * 0.9));
  EXPECT_GT(broken, 0) << "it would be needlessly strict";
  EXPECT_GT(kept, kSamples / 2);
}

}  // namespace
}  // namespace prospect::model
