// Which actions ran over which pictures, as files say it: transcriptions and CSV, which frames are
// kept and how they are labelled, who is held out.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>

#include "model/dataset.h"
#include "model/segments/hold_out.h"
#include "model/segments/segment_csv.h"
#include "model/segments/transcription.h"
#include "model/segments/trial_labels.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model::segments {
namespace {

std::string WhyRefused(const std::function<void()>& call) {
  try {
    call();
  } catch (const DataError& error) {
    return error.what();
  }
  return "not refused";
}

const std::vector<std::string>& Names() {
  static const std::vector<std::string> names = {"open", "pick(cup)", "put(cup,shelf)"};
  return names;
}

std::vector<std::string> Gestures() {
  std::vector<std::string> names;
  for (int i = 1; i <= 15; ++i) names.push_back("G" + std::to_string(i));
  return names;
}

class SegmentFiles : public ::testing::Test {
 protected:
  std::string Written(const std::string& text) const {
    const std::string path = folder_ / "trial.txt";
    std::ofstream(path) << text;
    return path;
  }
  Segmentation Transcribed(const std::string& text) const {
    return ReadTranscription(Written(text), Gestures());
  }
  std::vector<CsvRow> Rows(const std::string& text) const {
    return ReadSegmentCsv(Written(text), Names());
  }
  Segmentation Timed(const std::string& text) const {
    return FromSeconds(Rows(text), 10, folder_ / "trial.txt");
  }
  void ExpectRefused(const std::function<void()>& read, const std::string& said) const {
    const std::string why = WhyRefused(read);
    EXPECT_NE(why.find(said), std::string::npos) << why;
    EXPECT_NE(why.find("trial.txt"), std::string::npos) << why;
  }
  TestFolder folder_;
};

TEST_F(SegmentFiles, TranscriptionsAsDistributed) {
  const Segmentation t = Transcribed("80 283 G1 \n284 372 G5 \n373 463 G11 \n");
  ASSERT_EQ(t.spans.size(), 3U);
  EXPECT_TRUE(t.repairs.empty());
  EXPECT_EQ(t.spans[0].first, 79) << "frames count from 0 here, and from 1 there";
  EXPECT_EQ(t.spans[0].last, 282);
  EXPECT_EQ(t.spans[0].action, 0);
  EXPECT_EQ(t.spans[2].action, 10);
  EXPECT_EQ(Transcribed("1 5 G15\r\n\r\n6 9 G2").spans.size(), 2U);
}

TEST_F(SegmentFiles, FaultsOfTranscriptionsAreRefusedByLine) {
  const auto refused = [this](const std::string& text, const std::string& said) {
    ExpectRefused([&] { Transcribed(text); }, said);
  };
  refused("1 5 G1\n6 9 G16\n", "line 2: there is no action 'G16'; did you mean 'G1'?");
  refused("1 5 K\n", "there is no action 'K'");
  refused("1 5\n", "line 1: is not of the form");
  refused("1 5 G1 G2\n", "is not of the form");
  refused("one 5 G1\n", "is not of the form");
  refused("9 5 G1\n", "no stretch of a recording");
  refused("0 5 G1\n", "no stretch of a recording");
  refused("1 99999999 G1\n", "no stretch of a recording");
  refused("10 20 G1\n10 30 G2\n", "line 2: begins together with line 1");
  refused("\n\n", "holds no action");
  refused(std::string(5000, 'x'), "is not of the form");
  EXPECT_NE(WhyRefused([&] { ReadTranscription(folder_ / "none", {}); }).find("cannot be read"),
            std::string::npos);
}

TEST_F(SegmentFiles, AnActionThatRunsIntoTheNextEndsWhereThatBegins) {
  const Segmentation t = Transcribed("1 30 G1\n21 40 G2\n");
  EXPECT_EQ(t.spans[0].last, 19);
  ASSERT_EQ(t.repairs.size(), 1U);
  EXPECT_EQ(t.repairs[0],
            "line 2: overlaps the action before by 10 frames; that one ends where this begins");
}

TEST_F(SegmentFiles, RowsOutOfOrderAreSorted) {
  const Segmentation t = Timed("2,3,open,1\n0,1.5,pick(cup),1\n");
  ASSERT_EQ(t.repairs.size(), 1U);
  EXPECT_NE(t.repairs[0].find("line 2: begins before the row above it"), std::string::npos);
  EXPECT_EQ(t.spans[0].action, 1);
  EXPECT_EQ(t.spans[0].last, 15);
  EXPECT_EQ(t.spans[1].first, 20);
}

TEST_F(SegmentFiles, IsCutWhereTheRecordingEnds) {
  Segmentation t = Transcribed("1 10 G1\n11 20 G2\n21 30 G3\n");
  CutAtFrame(30, "t", &t);
  EXPECT_TRUE(t.repairs.empty());
  CutAtFrame(15, "t", &t);
  ASSERT_EQ(t.spans.size(), 2U);
  EXPECT_EQ(t.last(), 14);
  EXPECT_EQ(t.repairs.at(0),
            "goes 15 frames beyond the recording's 15; cut there, actions left out: 1");
  EXPECT_NE(
      WhyRefused([&] { CutAtFrame(0, "t.txt", &t); }).find("t.txt: the recording ends before"),
      std::string::npos);
}

TEST_F(SegmentFiles, ACsvMayHaveAHeaderNumbersQuotesAndACause) {
  const auto rows = Rows(
      "\xEF\xBB\xBFstart,end,action,succeeded,cause\r\n# by hand\n\n"
      "0.5, 1.25 ,open,yes\n1.25,2,1,TRUE\n2,3,\"put(cup,shelf)\",0,\"fell, \"\"loudly\"\"\"\n");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].start, 0.5);
  EXPECT_EQ(rows[0].end, 1.25);
  EXPECT_TRUE(rows[0].succeeded);
  EXPECT_EQ(rows[1].action, 1);
  EXPECT_EQ(rows[2].action, 2);
  EXPECT_FALSE(rows[2].succeeded);
  EXPECT_EQ(rows[2].cause, "fell, \"loudly\"");
  EXPECT_EQ(rows[2].line, 6);
}

TEST_F(SegmentFiles, ActionsThatTouchAreNoOverlap) {
  const Segmentation t = Timed("0.5,1.2,open,1\n1.2,2,pick(cup),0,slipped\n");
  EXPECT_TRUE(t.repairs.empty());
  EXPECT_EQ(t.spans[0].first, 5);
  EXPECT_EQ(t.spans[0].last, 11);
  EXPECT_EQ(t.spans[1].first, 12);
  EXPECT_EQ(t.spans[1].last, 20);
  EXPECT_EQ(t.spans[1].cause, "slipped");
}

TEST_F(SegmentFiles, FaultsOfCsvAreRefusedByLine) {
  const auto refused = [this](const std::string& text, const std::string& said) {
    ExpectRefused([&] { Timed(text); }, said);
  };
  refused("0,1,open,1\n1,2,pick(cop),1\n",
          "line 2: there is no action 'pick(cop)'; did you mean "
          "'pick(cup)'?");
  refused("0,1,3,1\n", "there is no action '3'");
  refused("0,1,open\n", "line 1: is not of the form 'start,end,action,succeeded'");
  refused("0,1,put(cup,shelf),1,x\n", "is not of the form");
  refused("0;1;open;1\n", "is not of the form");
  refused("-1,1,open,1\n", "start and end are numbers from 0");
  refused("0,nan,open,1\n", "start and end are numbers");
  refused("0,1,open,maybe\n", "whether it succeeded is 1 or 0");
  refused("2,1,open,1\n", "line 1: ends before it begins");
  refused("start,end,action,succeeded\n", "holds no action");
  refused(std::string(5000, 'x'), "longer than a row");
}

TEST_F(SegmentFiles, ATableOfDemonstrations) {
  const auto rows = ReadDemoCsv(
      Written("demo,start,end,action,succeeded\ndemo_3,0,4,open,1\ndemo_1,2,3,1,0\n"), Names());
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(FromFrames(rows.at("demo_3"), "t").last(), 4);
  EXPECT_FALSE(rows.at("demo_1").front().succeeded);
}

Segmentation TwoActions() {
  Segmentation t;
  t.spans = {{10, 14, 0, true, "", 1}, {18, 30, 4, true, "", 2}};
  t.used_from = 10;
  return t;
}

TEST(KeptFrames, EveryActionsFirstAndTheLast) {
  const KeptFrames keeps(TwoActions(), 5);
  std::vector<int> kept;
  for (int frame = 0; frame < 50; ++frame) {
    if (keeps.Keeps(frame)) kept.push_back(frame);
  }
  EXPECT_EQ(kept, (std::vector<int>{10, 15, 18, 20, 25, 30}));
  EXPECT_EQ(keeps.Count(), 6);
  EXPECT_EQ(KeptFrames(TwoActions(), 1).Count(), 21);
  EXPECT_EQ(KeptFrames(TwoActions(), 1000).Count(), 3);
}

Trial Labelled(const Segmentation& segmentation, const std::vector<int>& frames) {
  Trial trial;
  trial.task = "made";
  trial.num_actions = 5;
  trial.present.assign(5, 1);
  trial.width = trial.height = 32;
  PutLabels(segmentation, frames, &trial);
  EXPECT_NO_THROW(ValidateTrial(trial, /*with_images=*/false));
  return trial;
}

TEST(PutLabels, AGapBelongsToTheActionBeforeAndTheLastEndsWithItsOwnLastFrame) {
  const Trial trial = Labelled(TwoActions(), {10, 15, 18, 20, 25, 30});
  EXPECT_EQ(trial.actions, (std::vector<int>{0, 0, 4, 4, 4, 4}));
  EXPECT_EQ(trial.segment, (std::vector<int>{0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(trial.prev_action, (std::vector<int>{5, 5, 0, 0, 0, 0}));
  EXPECT_EQ(trial.dones.back(), 1);
  EXPECT_EQ(trial.rewards.back(), 1.0F);
  EXPECT_EQ(trial.outcome, "success");
}

TEST(PutLabels, FramesBeforeTheFirstActionBelongToNone) {
  Segmentation t = TwoActions();
  t.spans[1].succeeded = false;
  t.spans[1].cause = "fell";
  const Trial trial = Labelled(t, {5, 10, 18, 30});
  EXPECT_EQ(trial.actions, (std::vector<int>{5, 0, 4, 4}));
  EXPECT_EQ(trial.segment, (std::vector<int>{-1, 0, 1, 1}));
  EXPECT_EQ(trial.segment_succeeded, (std::vector<std::int8_t>{1, 0}));
  EXPECT_EQ(trial.outcome, "failure");
  EXPECT_EQ(trial.reason, "fell");
  EXPECT_EQ(trial.rewards.back(), -1.0F);
}

NamedTrials AllTrials() {
  NamedTrials trials;
  for (char user = 'B'; user <= 'I'; ++user) {
    for (int number = 1; number <= 5; ++number) {
      if (user == 'H' && number == 2) continue;  // as JIGSAWS is distributed: 39 trials
      const std::string name = std::string("Suturing_") + user + "00" + std::to_string(number);
      trials.emplace(name, NumberOfName(name));
    }
  }
  return trials;
}

int CountOf(const std::map<std::uint64_t, Split>& parts, Split split) {
  return static_cast<int>(std::count_if(parts.begin(), parts.end(),
                                        [&](const auto& part) { return part.second == split; }));
}

TEST(HoldOut, ATenthByHash) {
  const auto parts = AssignParts(AllTrials(), {});
  EXPECT_EQ(parts.size(), 39U);
  EXPECT_EQ(CountOf(parts, Split::kTest), 3);
  EXPECT_EQ(CountOf(parts, Split::kValid), 3);
  EXPECT_EQ(AssignParts(AllTrials(), {}), parts);
  const auto few = AssignParts({{"a", 1}, {"b", 2}, {"c", 3}}, {});
  EXPECT_EQ(CountOf(few, Split::kTrain), 1);
  EXPECT_EQ(CountOf(AssignParts({{"a", 1}, {"b", 2}}, {}), Split::kTrain), 2);
}

TEST(HoldOut, NamedTrials) {
  const auto parts = AssignParts(AllTrials(), {"B001", "Suturing_I005"});
  EXPECT_EQ(CountOf(parts, Split::kTest), 2);
  EXPECT_EQ(parts.at(NumberOfName("Suturing_B001")), Split::kTest);
  EXPECT_EQ(parts.at(NumberOfName("Suturing_I005")), Split::kTest);
  EXPECT_THROW(AssignParts(AllTrials(), {"H002"}), std::invalid_argument);
}

TEST(HoldOut, AllOfOnePerson) {
  const auto parts = AssignParts(AllTrials(), {"Suturing_H*"});
  EXPECT_EQ(CountOf(parts, Split::kTest), 4);
  EXPECT_EQ(parts.at(NumberOfName("Suturing_H003")), Split::kTest);
  EXPECT_THROW(AssignParts(AllTrials(), {"Suturing_A*"}), std::invalid_argument);
}

TEST(HoldOut, SomethingIsLeftToTrainOn) {
  EXPECT_THROW(AssignParts(AllTrials(), {"*"}), std::invalid_argument);
}

}  // namespace
}  // namespace prospect::model::segments
