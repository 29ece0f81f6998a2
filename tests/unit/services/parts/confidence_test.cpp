#include "services/executive/confidence.h"

#include <gtest/gtest.h>

#include "services/executive/explanation.h"
#include "services/executive/report.h"

namespace prospect::services {
namespace {

using model::SceneClass;
using model::SceneEnding;

// 30 scenes that score 0.2 to 0.229 of which 10 are solved, and 50 that score 0.8 to 0.849, 45.
model::CalibrationSample Sample() {
  model::CalibrationSample sample;
  sample.rule = "paper";
  sample.parameters = {{"samples", 30}};
  for (int i = 0; i < 30; ++i)
    sample.scenes.push_back({0.2 + 0.001 * i, SceneClass::kSolvable,
                             i % 3 == 0 ? SceneEnding::kSolved : SceneEnding::kFailed});
  for (int i = 0; i < 50; ++i)
    sample.scenes.push_back({0.8 + 0.001 * i, SceneClass::kSolvable,
                             i % 10 == 5 ? SceneEnding::kFailed : SceneEnding::kSolved});
  return sample;
}

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Confidence, CountsScenesOfLikeScore) {
  const Confidence sure = ConfidenceOf(Sample(), 0.9, "paper", {{"samples", 30}}, false);
  EXPECT_EQ(sure.sample, 80);
  EXPECT_GE(sure.scenes, 20);
  EXPECT_GE(sure.share(), 0.8);
  EXPECT_EQ(sure.caveat, "");
  const Confidence unsure = ConfidenceOf(Sample(), 0.21, "paper", {{"samples", 30}}, false);
  EXPECT_EQ(unsure.scenes, 30);
  EXPECT_EQ(unsure.solved, 10);
  EXPECT_EQ(SuccessSentence(unsure),
            "Succeeds in about 33 %: of 30 calibration scenes whose plan scored 0.200 to 0.229, "
            "10 were solved.");
  EXPECT_EQ(SuccessSentence(unsure, false).rfind("Carried out, it would succeed in about 33 %", 0),
            0u);
  EXPECT_EQ(SuccessSentence(ConfidenceOf({}, 0.5, "paper", {}, false)), "");
}

TEST(Confidence, SaysWhatTheCalibrationDoesNotCover) {
  const Confidence other = ConfidenceOf(Sample(), 0.9, "puct", {{"samples", 10}}, true);
  EXPECT_EQ(other.caveat,
            "The calibration does not cover this search: rule puct instead of paper, samples 10 "
            "instead of 30, a goal, where the calibration had the task's own.");
}

TEST(RiskChart, ShowsTheCurveAndTheThresholdOnIt) {
  const Confidence confidence = ConfidenceOf(Sample(), 0.9, "paper", {}, false);
  const std::string chart = RiskChart(confidence, 0.5);
  EXPECT_EQ(chart.rfind("<svg ", 0), 0u);
  EXPECT_TRUE(Holds(chart, "<polyline "));
  EXPECT_TRUE(Holds(chart, "<circle ")) << "the threshold";
  EXPECT_FALSE(Holds(RiskChart(confidence, 0.9), "<circle ")) << "above every score";
  // Half of the wide range: 50 of 80 are attempted at 0.5, at x = 48 + 0.625 * 298.
  EXPECT_TRUE(Holds(chart, "<circle cx=\"234.2\"")) << chart;
  EXPECT_EQ(RiskChart({}, 0.5), "");
}

Explanation Refused() {
  Explanation explanation;
  explanation.reason = "too low";
  explanation.chosen.steps.resize(1);
  explanation.confidence = ConfidenceOf(Sample(), 0.21, "paper", {}, true);
  explanation.confidence->promises = {"Refuses at most 5 %."};
  return explanation;
}

TEST(ConfidenceSentences, TellSuccessPromisesAndCaveat) {
  const auto sentences = ConfidenceSentences(Refused());
  ASSERT_EQ(sentences.size(), 3u);
  EXPECT_TRUE(Holds(sentences[0], "it would succeed in about 33 %"));
  EXPECT_EQ(sentences[1], "Refuses at most 5 %.");
  EXPECT_TRUE(Holds(sentences[2], "does not cover"));
  Explanation no_plan = Refused();
  no_plan.chosen.steps.clear();
  EXPECT_EQ(ConfidenceSentences(no_plan).size(), 2u) << "without a plan nothing would succeed";
  EXPECT_TRUE(ConfidenceSentences({}).empty());
}

TEST(ConfidenceInReports, StandsInTheTableAndInResultJson) {
  EpisodeRecord record;
  record.outcome = "solved";
  record.confidence = ConfidenceOf(Sample(), 0.21, "paper", {}, false);
  record.confidence->promises = {"Refuses at most 5 %."};
  record.searches.resize(1);
  record.searches[0].act = true;
  record.searches[0].steps.resize(1);
  EXPECT_TRUE(Holds(PlanTable(record), "At the start: Succeeds in about 33 %"));
  EXPECT_TRUE(Holds(PlanTable(record), "Refuses at most 5 %."));
  const std::string json = ResultJson(record, 0);
  EXPECT_TRUE(Holds(json, "\"success\": 0.3333"));
  EXPECT_TRUE(Holds(json, "\"calibration_scenes\": 80"));
  record.confidence.reset();
  EXPECT_FALSE(Holds(ResultJson(record, 0), "\"confidence\""));
}

}  // namespace
}  // namespace prospect::services
