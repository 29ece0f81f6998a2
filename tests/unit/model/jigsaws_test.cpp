// JIGSAWS on disk: transcriptions, which frames are kept and how they are labelled, who is held
// out.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>

#include "model/dataset.h"
#include "model/jigsaws/gestures.h"
#include "model/jigsaws/hold_out.h"
#include "model/jigsaws/transcription.h"
#include "model/jigsaws/trial_labels.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model::jigsaws {
namespace {

std::string WhyRefused(const std::function<void()>& call) {
  try {
    call();
  } catch (const DataError& error) {
    return error.what();
  }
  return "not refused";
}

class TranscriptionTest : public ::testing::Test {
 protected:
  std::string Written(const std::string& text) const {
    const std::string path = folder_ / "Suturing_B001.txt";
    std::ofstream(path) << text;
    return path;
  }
  Transcription Read(const std::string& text) const { return ReadTranscription(Written(text)); }
  void ExpectRefused(const std::string& text, const std::string& said) const {
    const std::string path = Written(text);
    const std::string why = WhyRefused([&] { ReadTranscription(path); });
    EXPECT_NE(why.find(said), std::string::npos) << text << " gave: " << why;
    EXPECT_NE(why.find("Suturing_B001.txt"), std::string::npos) << why;
  }
  TestFolder folder_;
};

TEST_F(TranscriptionTest, AsDistributed) {
  const Transcription t = Read("80 283 G1 \n284 372 G5 \n373 463 G11 \n");
  ASSERT_EQ(t.spans.size(), 3U);
  EXPECT_TRUE(t.repairs.empty());
  EXPECT_EQ(t.spans[0].first, 80);
  EXPECT_EQ(t.spans[0].last, 283);
  EXPECT_EQ(t.spans[0].action, 0);
  EXPECT_EQ(t.spans[2].action, 10);
  EXPECT_EQ(Read("1 5 G15\r\n\r\n6 9 G2").spans.size(), 2U);
}

TEST_F(TranscriptionTest, AGestureThatRunsIntoTheNextEndsWhereThatBegins) {
  const Transcription t = Read("1 30 G1\n21 40 G2\n");
  EXPECT_EQ(t.spans[0].last, 20);
  ASSERT_EQ(t.repairs.size(), 1U);
  EXPECT_NE(t.repairs[0].find("line 2: overlaps the gesture before by 10 frames"),
            std::string::npos)
      << t.repairs[0];
}

TEST_F(TranscriptionTest, FaultsAreRefusedByLine) {
  ExpectRefused("1 5 G1\n6 9 G16\n", "line 2: unknown gesture 'G16'");
  ExpectRefused("1 5 K1\n", "unknown gesture 'K1'");
  ExpectRefused("1 5\n", "line 1: is not of the form");
  ExpectRefused("1 5 G1 G2\n", "is not of the form");
  ExpectRefused("one 5 G1\n", "is not of the form");
  ExpectRefused("9 5 G1\n", "no stretch of a video");
  ExpectRefused("0 5 G1\n", "no stretch of a video");
  ExpectRefused("1 99999999 G1\n", "no stretch of a video");
  ExpectRefused("10 20 G1\n10 30 G2\n", "line 2: begins at frame 10, not after");
  ExpectRefused("10 20 G1\n1 5 G2\n", "not after the gesture before it");
  ExpectRefused("\n\n", "holds no gesture");
  ExpectRefused(std::string(5000, 'x'), "is not of the form");
  EXPECT_NE(WhyRefused([&] { ReadTranscription(folder_ / "none.txt"); }).find("cannot be read"),
            std::string::npos);
}

TEST_F(TranscriptionTest, IsCutWhereTheVideoEnds) {
  Transcription t = Read("1 10 G1\n11 20 G2\n21 30 G3\n");
  CutAtFrame(30, "t", &t);
  EXPECT_TRUE(t.repairs.empty());
  CutAtFrame(15, "t", &t);
  ASSERT_EQ(t.spans.size(), 2U);
  EXPECT_EQ(t.last(), 15);
  EXPECT_EQ(t.repairs.at(0),
            "goes 15 frames beyond the video's 15; cut there, 1 gestures left out");
  EXPECT_NE(WhyRefused([&] { CutAtFrame(0, "t.txt", &t); }).find("t.txt: the video ends before"),
            std::string::npos);
}

TEST(KeptFrames, EveryGesturesFirstAndTheLast) {
  const Transcription t{{{10, 14, 0}, {18, 30, 4}}, {}};
  const KeptFrames keeps(t, 5);
  std::vector<int> kept;
  for (int frame = 1; frame < 50; ++frame) {
    if (keeps.Keeps(frame)) kept.push_back(frame);
  }
  EXPECT_EQ(kept, (std::vector<int>{10, 15, 18, 20, 25, 30}));
  EXPECT_EQ(keeps.Count(), 6);
  EXPECT_EQ(KeptFrames(t, 1).Count(), 21);
  EXPECT_EQ(KeptFrames(t, 1000).Count(), 3);
}

TEST(LabelsOf, AGapBelongsToTheGestureBeforeAndTheLastEndsWithItsOwnLastFrame) {
  const Transcription t{{{10, 14, 0}, {18, 30, 4}}, {}};
  Trial trial = LabelsOf(t, {10, 15, 18, 20, 25, 30}, 5, 1.0 / 30);
  EXPECT_EQ(trial.actions, (std::vector<int>{0, 0, 4, 4, 4, 4}));
  EXPECT_EQ(trial.segment, (std::vector<int>{0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(trial.prev_action, (std::vector<int>{15, 15, 0, 0, 0, 0}));
  EXPECT_EQ(trial.dones.back(), 1);
  EXPECT_EQ(trial.plan_length, 2);
  EXPECT_DOUBLE_EQ(trial.tick_seconds, 5.0 / 30);
  trial.task = "suturing";
  trial.seed = 1001;
  EXPECT_NO_THROW(ValidateTrial(trial, /*with_images=*/false));
}

TEST(TrialName, SaysUserAndNumber) {
  const TrialName name = ParseTrialName("Knot_Tying", "Knot_Tying_C004");
  EXPECT_EQ(name.user, 'C');
  EXPECT_EQ(name.number, 4);
  EXPECT_EQ(name.seed(), 2004U);
  for (const char* bad :
       {"Suturing_C004", "Knot_Tying_C04", "Knot_Tying_c004", "Knot_Tying_", "x"}) {
    EXPECT_THROW(ParseTrialName("Knot_Tying", bad), DataError) << bad;
  }
}

std::vector<TrialName> AllTrials() {
  std::vector<TrialName> trials;
  for (char user = 'B'; user <= 'I'; ++user) {
    for (int number = 1; number <= 5; ++number) {
      if (user == 'H' && number == 2) continue;  // as distributed: 39 trials
      trials.push_back(ParseTrialName(
          "Suturing", std::string("Suturing_") + user + "00" + std::to_string(number)));
    }
  }
  return trials;
}

int CountOf(const std::map<std::uint64_t, Split>& parts, Split split) {
  return static_cast<int>(std::count_if(parts.begin(), parts.end(),
                                        [&](const auto& part) { return part.second == split; }));
}

TEST(HoldOut, ThreeTrialsByHash) {
  const auto parts = AssignParts(AllTrials(), {});
  EXPECT_EQ(parts.size(), 39U);
  EXPECT_EQ(CountOf(parts, Split::kTest), 3);
  EXPECT_EQ(CountOf(parts, Split::kValid), 3);
  EXPECT_EQ(AssignParts(AllTrials(), {}), parts);
  HoldOut more;
  more.trials = 5;
  const auto five = AssignParts(AllTrials(), more);
  for (const auto& [seed, part] : parts) {
    if (part == Split::kTest) {
      EXPECT_EQ(five.at(seed), Split::kTest) << seed << ": more are added to the same";
    }
  }
}

TEST(HoldOut, NamedTrials) {
  HoldOut named;
  named.names = {"B001", "Suturing_I005"};
  named.valid = 0;
  const auto parts = AssignParts(AllTrials(), named);
  EXPECT_EQ(CountOf(parts, Split::kTest), 2);
  EXPECT_EQ(CountOf(parts, Split::kValid), 0);
  EXPECT_EQ(parts.at(1001), Split::kTest);
  EXPECT_EQ(parts.at(8005), Split::kTest);
  named.names = {"H002"};
  EXPECT_THROW(AssignParts(AllTrials(), named), std::invalid_argument);
}

TEST(HoldOut, OneUser) {
  HoldOut one;
  one.user = 'H';
  const auto parts = AssignParts(AllTrials(), one);
  EXPECT_EQ(CountOf(parts, Split::kTest), 4);
  for (const auto& [seed, part] : parts) EXPECT_EQ(part == Split::kTest, seed / 1000 == 7) << seed;
  one.user = 'A';
  EXPECT_THROW(AssignParts(AllTrials(), one), std::invalid_argument);
}

TEST(HoldOut, SomethingIsLeftToTrainOn) {
  HoldOut all;
  all.trials = 36;
  EXPECT_THROW(AssignParts(AllTrials(), all), std::invalid_argument);
}

TEST(Gestures, NamesAndTasks) {
  EXPECT_EQ(GestureName(0), "G1");
  EXPECT_EQ(GestureAction("G15"), 14);
  EXPECT_EQ(GestureAction("G0"), -1);
  EXPECT_EQ(GestureAction("G011"), -1);
  EXPECT_TRUE(IsGestureTask("suturing"));
  EXPECT_TRUE(IsGestureTask("needle_passing"));
  EXPECT_FALSE(IsGestureTask("Suturing"));
  EXPECT_FALSE(IsGestureTask("stacking"));
  EXPECT_EQ(TaskOfFolder("Knot_Tying"), "knot_tying");
}

}  // namespace
}  // namespace prospect::model::jigsaws
