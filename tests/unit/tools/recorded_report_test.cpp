#include "tools/common/recorded_report.h"

#include <gtest/gtest.h>

namespace prospect::tools {
namespace {

model::RecordedTrial TrialOf(double score, bool succeeded, bool given_up = false) {
  model::RecordedTrial trial;
  trial.score = score;
  trial.succeeded = succeeded;
  trial.given_up = given_up;
  trial.steps = {{0, true, 0.9F, 0.9F}, {1, succeeded, static_cast<float>(score), 0.5F}};
  return trial;
}

model::RecordedTrials Trials() {
  model::RecordedTrials judged;
  judged.trials = {TrialOf(0.9, true), TrialOf(0.2, false), TrialOf(0.7, true, true),
                   TrialOf(0.1, false, true)};
  return judged;
}

// Whether a scene could have been done is known only where its plan succeeded.
TEST(RecordedSample, APlanThatFailedMakesNoSceneHopeless) {
  const model::CalibrationSample sample = SampleOf(Trials());
  ASSERT_EQ(sample.scenes.size(), 4U);
  int solvable = 0, refused = 0;
  for (const model::CalibrationScene& scene : sample.scenes) {
    EXPECT_NE(scene.scene_class, model::SceneClass::kHopeless);
    solvable += scene.scene_class == model::SceneClass::kSolvable;
    refused += scene.ending == model::SceneEnding::kRefused;
  }
  EXPECT_EQ(solvable, 2);
  EXPECT_EQ(refused, 2);  // one of which could have been done: no threshold brings it back
  EXPECT_DOUBLE_EQ(sample.scenes.back().score, 0.9);
  EXPECT_EQ(sample.scenes.back().ending, model::SceneEnding::kSolved);
}

TEST(RecordedReport, CountsAndJudgesByAction) {
  const nlohmann::json report = ReportOf(Trials(), {"take", "put", "never"}, std::nullopt);
  EXPECT_EQ(report["trials"], 4);
  EXPECT_EQ(report["succeeded"], 2);
  EXPECT_EQ(report["given_up_succeeded"], 1);
  EXPECT_EQ(report["f"]["actions"][1]["samples"], 4);
  EXPECT_DOUBLE_EQ(report["f"]["actions"][1]["base_rate"], 0.5);
  EXPECT_DOUBLE_EQ(report["f"]["actions"][1]["area_under_roc"], 1);
  EXPECT_EQ(report["f"]["actions"][2]["samples"], 0);
  EXPECT_TRUE(report["novelty"].is_null());
}

TEST(RecordedReport, SaysWhichActionsWereNotShownToBeLearned) {
  const std::string words = RecordedWords(ReportOf(Trials(), {"take", "put"}, std::nullopt));
  EXPECT_NE(words.find("Not better than guessing: f for take (4 examples)"), std::string::npos)
      << words;
  EXPECT_NE(words.find("More trials would help most of: take that fails (0 here)"),
            std::string::npos)
      << words;
}

}  // namespace
}  // namespace prospect::tools
