#include "tools/evaluate/calibrate.h"

#include <gtest/gtest.h>

namespace prospect::tools {
namespace {

using model::SceneClass;
using model::SceneEnding;

SceneRecord Record(const std::string& scene_class, const std::string& ending, double score) {
  return {{"class", scene_class},
          {"solved_at_start", false},
          {"rows", {{"planner", {{"ending", ending}, {"score", score}}}}}};
}

TEST(SampleFromRecords, KeepsScoreClassAndEndingByScore) {
  const auto sample =
      SampleFrom({Record("solvable", "stopped", 0.7), Record("hopeless", "failed", 0.2),
                  Record("doubtful", "solved", 0.4)});
  ASSERT_EQ(sample.scenes.size(), 3u);
  EXPECT_EQ(sample.scenes[0].score, 0.2);
  EXPECT_EQ(sample.scenes[0].scene_class, SceneClass::kHopeless);
  EXPECT_EQ(sample.scenes[0].ending, SceneEnding::kFailed);
  EXPECT_EQ(sample.scenes[1].scene_class, SceneClass::kDoubtful);
  EXPECT_EQ(sample.scenes[1].ending, SceneEnding::kSolved);
  EXPECT_EQ(sample.scenes[2].ending, SceneEnding::kStopped);
}

TEST(SampleFromRecords, ARefusedScenesScoreSaysNothing) {
  const auto sample = SampleFrom({Record("solvable", "refused", 0.9)});
  EXPECT_EQ(sample.scenes.at(0).score, 0);
  EXPECT_FALSE(sample.scenes.at(0).attempted());
}

TEST(SampleFromRecords, LeavesOutScenesSolvedAtTheStart) {
  SceneRecord solved = Record("solvable", "solved", 0.9);
  solved["solved_at_start"] = true;
  EXPECT_TRUE(SampleFrom({solved}).empty());
}

TEST(SampleFromRecords, NamesWhatIsNoRecord) {
  EXPECT_THROW(SampleFrom({Record("easy", "solved", 0.9)}), std::invalid_argument);
  EXPECT_THROW(SampleFrom({Record("solvable", "won", 0.9)}), std::invalid_argument);
  EXPECT_THROW(SampleFrom({SceneRecord{{"class", "solvable"}}}), std::invalid_argument);
}

std::vector<SceneRecord> Many() {
  std::vector<SceneRecord> records;
  for (int i = 1; i <= 99; ++i) records.push_back(Record("solvable", "solved", i / 100.0));
  return records;
}

TEST(CalibrationFromSample, StoresThePromiseAndItsThreshold) {
  std::vector<std::string> words;
  const auto calibration =
      CalibrationFrom(SampleFrom(Many()), {0.1, std::nullopt, 0.1}, "by hand", &words);
  EXPECT_DOUBLE_EQ(calibration.refusal_threshold, 0.1);
  EXPECT_EQ(calibration.scenes, 99);
  EXPECT_EQ(calibration.alpha, 0.1);
  EXPECT_FALSE(calibration.epsilon);
  EXPECT_EQ(calibration.command, "by hand");
  EXPECT_EQ(calibration.sample.scenes.size(), 99u);
  EXPECT_EQ(words.size(), 1u);
}

// Of too few scenes no share of failures can be promised; what they showed is taken and said.
TEST(CalibrationFromSample, WhatCannotBePromisedGoesByWhatWasSeen) {
  const auto sample =
      SampleFrom({Record("solvable", "failed", 0.2), Record("solvable", "solved", 0.3),
                  Record("solvable", "failed", 0.4), Record("solvable", "solved", 0.6),
                  Record("solvable", "solved", 0.7), Record("solvable", "solved", 0.8)});
  std::vector<std::string> words;
  const auto calibration = CalibrationFrom(sample, {std::nullopt, 0.25, 0.1}, "", &words);
  EXPECT_DOUBLE_EQ(calibration.refusal_threshold, 0.3);
  EXPECT_FALSE(calibration.epsilon) << "nothing is promised";
  EXPECT_NE(words.back().find("1 of 5 attempted"), std::string::npos) << words.back();
}

TEST(CalibrationFromSample, WhereAllFailsAllIsRefused) {
  std::vector<std::string> words;
  const auto calibration = CalibrationFrom(SampleFrom({Record("solvable", "failed", 0.9)}),
                                           {std::nullopt, 0.25, 0.1}, "", &words);
  EXPECT_EQ(calibration.refusal_threshold, 1);
  EXPECT_NE(words.back().find("all is refused"), std::string::npos) << words.back();
}

TEST(CoveredParameters, AreThoseThatChangeScores) {
  planner::SearchParameters search;
  search.samples = 10;
  const auto parameters = CoveredParameters(search, {9, 4, 2}, 2);
  EXPECT_EQ(parameters.at("samples"), 10);
  EXPECT_EQ(parameters.at("plan_length"), 9);
  EXPECT_EQ(parameters.at("objects"), 4);
  EXPECT_EQ(parameters.at("retries"), 2);
  EXPECT_EQ(parameters.at("v_failed"), search.v_failed);
}

}  // namespace
}  // namespace prospect::tools
