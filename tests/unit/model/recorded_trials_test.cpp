#include "model/recorded_trials.h"

#include <gtest/gtest.h>

#include "model/scripted_engine.h"
#include "model/weights_error.h"
#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

constexpr int kSize = 32;

ScriptedEngine EngineFor(const std::string& task) {
  ScriptedOptions options;
  options.task = task;
  options.num_actions = 3;
  options.offered_actions = 3;
  options.failing_share = 0;
  options.image_width = options.image_height = kSize;
  return ScriptedEngine(options);
}

std::string FileOf(const TestFolder& folder, const std::vector<Trial>& trials) {
  std::vector<std::string> parts;
  for (const Trial& trial : trials) {
    parts.push_back(folder / ("trial" + std::to_string(trial.seed) + ".h5"));
    WriteTrialFile(parts.back(), trial);
  }
  const std::string path = folder / "trials.h5";
  PackTrialFiles(parts, path);
  return path;
}

TEST(RecordedTrials, OnlyWhatNothingIsTrainedOnIsHeldOut) {
  const TestFolder folder;
  std::vector<Trial> trials;
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    trials.push_back(MadeTrial(seed, 2, false, 4, kSize));
  const TrialFile file(FileOf(folder, trials));
  EXPECT_EQ(HeldOutTrials(file, true).size(), 40U);
  const std::vector<std::size_t> held_out = HeldOutTrials(file, false);
  EXPECT_FALSE(held_out.empty());
  EXPECT_LT(held_out.size(), 20U);
  for (const std::size_t i : held_out) EXPECT_NE(file.part(i), Split::kTrain);
}

TEST(RecordedTrials, ThePlanIsScoredAsASearchFromTheFirstPictureScoresIt) {
  const TestFolder folder;
  const Trial trial = MadeTrial(5, 2, true, 4, kSize);
  const TrialFile file(FileOf(folder, {trial}));
  ScriptedEngine engine = EngineFor("made");
  const RecordedTrials judged = JudgeRecorded(engine, file, {0}, {});
  const Hidden h0 = engine.Encode(Pixels(trial.frame(0), trial.frame_bytes()));
  const Prediction one = engine.Expand({{h0, h0, trial.actions[1]}}).front();
  const Prediction two = engine.Expand({{h0, one.h, trial.actions.back()}}).front();
  ASSERT_EQ(judged.trials.size(), 1U);
  const RecordedTrial& plan = judged.trials[0];
  EXPECT_NEAR(plan.score, one.done * two.done * two.value, 1e-6);
  EXPECT_FALSE(plan.succeeded);
  ASSERT_EQ(plan.steps.size(), 2U);
  EXPECT_TRUE(plan.steps[0].succeeded);
  EXPECT_FALSE(plan.steps[1].succeeded);
  EXPECT_FLOAT_EQ(plan.steps[1].done_ahead, two.done);
  EXPECT_EQ(judged.after_one.pictures, 2U);
  EXPECT_EQ(judged.after_two.pictures, 1U);
  EXPECT_GT(judged.after_one.copied_changed, judged.after_one.copied);
}

TEST(RecordedTrials, APlanThatASearchWouldNotFollowIsGivenUp) {
  const TestFolder folder;
  const TrialFile file(FileOf(folder, {MadeTrial(5, 2, false, 4, kSize)}));
  ScriptedEngine engine = EngineFor("made");
  EXPECT_FALSE(JudgeRecorded(engine, file, {0}, {0, 0, 0}).trials[0].given_up);
  EXPECT_TRUE(JudgeRecorded(engine, file, {0}, {1.1, 0, 0}).trials[0].given_up);
  EXPECT_TRUE(JudgeRecorded(engine, file, {0}, {0, 1.1, 0}).trials[0].given_up);
  EXPECT_TRUE(JudgeRecorded(engine, file, {0}, {0, 0, 1.1}).trials[0].given_up);
}

TEST(RecordedTrials, TrialsOfAnotherTaskAreRefused) {
  const TestFolder folder;
  const TrialFile file(FileOf(folder, {MadeTrial(5, 2, false, 4, kSize)}));
  ScriptedEngine engine = EngineFor("other");
  EXPECT_THROW(JudgeRecorded(engine, file, {0}, {}), DataError);
}

}  // namespace
}  // namespace prospect::model
