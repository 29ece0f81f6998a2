#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <set>

#include "base/disk_error.h"
#include "report/refusal_plot.h"
#include "tests/unit/model/refusal_sample.h"
#include "tests/unit/model/test_folder.h"
#include "tests/unit/report/png_size.h"
#include "tools/refusals/report.h"
#include "tools/refusals/splits.h"

namespace prospect::tools {
namespace {

using model::CalibrationSample;
using model::SampleOf;
using model::Scene;

// Solvable scenes of all scores; below 0.2 they fail, above they are solved.
CalibrationSample Solvable(int n) {
  std::vector<model::CalibrationScene> scenes;
  for (int i = 0; i < n; ++i) {
    const double score = (i + 0.5) / n;
    scenes.push_back(Scene(score, 's', score < 0.2 ? 'F' : 'S'));
  }
  return SampleOf(scenes);
}

TEST(SplitInHalves, PartsTheSceneAndDependsOnTheSeedAlone) {
  const CalibrationSample sample = Solvable(41);
  const Halves halves = SplitInHalves(sample, 7);
  EXPECT_EQ(halves.calibration.scenes.size(), 21u);
  EXPECT_EQ(halves.test.scenes.size(), 20u);
  std::set<double> scores;
  for (const auto* half : {&halves.calibration, &halves.test}) {
    double before = -1;
    for (const auto& scene : half->scenes) {
      EXPECT_TRUE(scores.insert(scene.score).second);
      EXPECT_GT(scene.score, before) << "ascending";
      before = scene.score;
    }
  }
  EXPECT_EQ(scores.size(), 41u);
  EXPECT_EQ(SplitInHalves(sample, 7).test.scenes[3].score, halves.test.scenes[3].score);
  EXPECT_NE(SplitInHalves(sample, 8).test.scenes[3].score, halves.test.scenes[3].score);
}

TEST(TestRefuseAtMost, CountsTheTestHalfBelowTheCalibrationHalfsThreshold) {
  Halves halves;
  halves.calibration = Solvable(19);  // alpha 0.1: k = 2, the second smallest is 1.5 / 19
  halves.test = SampleOf(
      {Scene(0.05, 's', 'F'), Scene(0.07, 's', 'S'), Scene(0.06, 's', 'S'), Scene(0.01, 'h', 'F')});
  const SplitOutcome outcome = TestRefuseAtMost(halves, 0.1);
  EXPECT_TRUE(outcome.kept);
  EXPECT_DOUBLE_EQ(outcome.threshold, 1.5 / 19);
  EXPECT_EQ(outcome.count, 3);
  EXPECT_EQ(outcome.total, 3);
  const model::CountBand band = model::BetaBinomialBand(3, 2, 18, 0.95);
  EXPECT_EQ(outcome.band.low, band.low);
  EXPECT_EQ(outcome.band.high, band.high);
  EXPECT_EQ(band.high, 2);
  EXPECT_FALSE(outcome.within());
}

TEST(TestFailAtMost, CountsFailuresOfTheTestHalfsAttempts) {
  Halves halves;
  halves.calibration = Solvable(200);
  halves.test = SampleOf(
      {Scene(0.9, 's', 'S'), Scene(0.8, 'h', 'F'), Scene(0.01, 's', 'F'), Scene(0.7, 's', 'T')});
  const SplitOutcome outcome = TestFailAtMost(halves, 0.1, 0.1);
  EXPECT_TRUE(outcome.kept);
  EXPECT_GT(outcome.threshold, 0.01);
  EXPECT_LT(outcome.threshold, 0.7);
  EXPECT_EQ(outcome.count, 1);
  EXPECT_EQ(outcome.total, 3);
  EXPECT_EQ(outcome.band.low, 0);
  halves.calibration = Solvable(10);
  EXPECT_FALSE(TestFailAtMost(halves, 0.1, 0.1).kept);
}

// Over many splits the mean is k / (n + 1), and the band holds as often as it says.
TEST(RefuseSplits, MeanAndBandAreWhatTheTheorySays) {
  const SplitSummary summary = RunRefuseSplits(Solvable(400), 0.05, 2000, 1);
  EXPECT_EQ(summary.kept, 2000);
  EXPECT_NEAR(summary.mean, 10.0 / 201, 0.0025);
  EXPECT_GE(summary.within, 1880);
  EXPECT_LE(summary.within, 1990);
  EXPECT_NEAR(summary.standard_error, 0.0218 / 44.7, 0.0001);
}

TEST(FailSplits, StayBelowThePromise) {
  const SplitSummary summary = RunFailSplits(Solvable(400), 0.1, 0.1, 200, 1);
  EXPECT_EQ(summary.kept, 200);
  EXPECT_LT(summary.mean, 0.1);
  EXPECT_GT(summary.mean, 0.01);
  EXPECT_GE(summary.within, 180);
}

TEST(Report, TellsTheSameInFiguresAndWords) {
  RefusalOptions options;
  const auto figures = MeasureRefusals(Solvable(400), "made", options);
  EXPECT_EQ(figures["scenes"], 400);
  EXPECT_EQ(figures["solvable"], 400);
  EXPECT_EQ(figures["refuse"]["rates"].size(), 20u);
  EXPECT_EQ(figures["curve"].size(), 400u);
  EXPECT_NEAR(figures["coverage_at_10"].get<double>(), 0.8 / 0.9, 0.005);
  EXPECT_EQ(figures["auroc"], -1) << "nothing is hopeless";
  const std::string table = RefusalTable(figures);
  char mean[40];
  std::snprintf(mean, sizeof mean, "mean %5.2f %%", 100 * figures["fail"]["mean"].get<double>());
  EXPECT_NE(table.find(mean), std::string::npos) << table;
  EXPECT_NE(table.find("made: 400 scenes"), std::string::npos) << table;
}

TEST(Plot, HasAPanelATask) {
  const model::TestFolder folder;
  const auto figures = MeasureRefusals(Solvable(400), "made", {});
  report::WriteRefusalPlot(folder / "one.png", {figures});
  report::WriteRefusalPlot(folder / "two.png", {figures, figures});
  const auto one = report::PngSize(folder / "one.png"), two = report::PngSize(folder / "two.png");
  EXPECT_GT(two.width, one.width);
  EXPECT_LE(two.height, one.height) << "beside each other; the words below have more room";
  EXPECT_THROW(report::WriteRefusalPlot(folder / "none/one.png", {figures}), base::DiskError);
}

}  // namespace
}  // namespace prospect::tools
