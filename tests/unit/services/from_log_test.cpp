#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/exit_error.h"
#include "model/dataset.h"
#include "services/common/authenticity.h"
#include "services/from_log/log_importer.h"
#include "tests/unit/services/log_writer.h"

namespace prospect::services {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 2;
constexpr int kActions = 2;

task_t Task() {
  task_t task{};
  task.name = "made";
  task.world_version = "made-1";
  task.actions = {{0, "a", "a", "x", 1, {1}}, {1, "b", "b", "y", 1, {0}}};
  task.initial = {0, 1};
  task.plan_length = 2;
  task.image_width = task.image_height = kSide;
  task.tick_seconds = 0.1;
  task.action_time_limit = 10;
  return task;
}

observation_t Observation(std::int64_t episode, std::int64_t frame) {
  observation_t m{};
  m.episode_id = episode;
  m.frame = frame;
  m.encoding = observation_t::ENCODING_RGB8;
  m.width = m.height = kSide;
  m.data.assign(kSide * kSide * 3, static_cast<std::uint8_t>(10 * frame + episode));
  return m;
}

// Frame 0 comes before the first action, 1 and 2 are the first action's, 3 and 4 the second's, on
// which the trial ends.
label_t Label(std::int64_t episode, std::int64_t frame,
              std::int8_t verdict = label_t::OUTCOME_SUCCESS) {
  label_t m{};
  m.episode_id = episode;
  m.frame = frame;
  m.seed = -1;
  m.segment = static_cast<int>((frame + 1) / 2) - 1;
  m.action = m.segment < 0 ? kActions : m.segment;
  m.previous_action = m.segment == 1 ? 0 : kActions;
  m.segment_end = frame == 2 || frame == 4;
  m.outcome = frame == 4 ? verdict : label_t::OUTCOME_RUNNING;
  m.reason = m.outcome == label_t::OUTCOME_FAILURE ? "time" : "";
  m.light = 1.05;
  m.image_noise = 0.01;
  m.present = {1, 1};
  return m;
}

class FromLog : public testing::Test {
 protected:
  FromLog() : path_(testing::TempDir() + "/from_log_" + std::to_string(getpid()) + ".lcmlog") {}
  ~FromLog() override { fs::remove(path_); }

  void WriteRun(LogWriter& log, std::int64_t episode, std::int64_t missing = -1,
                std::int8_t verdict = label_t::OUTCOME_SUCCESS) {
    for (std::int64_t frame = 0; frame <= 4; ++frame) {
      if (frame == missing) continue;
      log.Write(Observation(episode, frame));
      log.Write(Label(episode, frame, verdict));
    }
  }

  void Import() {
    EventLog log(path_);
    LogEvent event;
    while (log.Next(event)) importer_.Take(event);
    importer_.EndOfLog();
    damaged_ = log.damaged();
  }

  std::string Refusal() {
    Import();
    return importer_.rows().size() == 1 && trials_.empty() ? importer_.rows()[0].reason
                                                           : "not refused";
  }

  std::string path_;
  std::vector<model::Trial> trials_;
  LogImporter importer_{[this](const model::Trial& trial) { trials_.push_back(trial); }};
  std::int64_t damaged_ = 0;
};

TEST_F(FromLog, ARunBecomesATrial) {
  {
    LogWriter log(path_);
    log.Write(Task());
    WriteRun(log, 7);
  }
  Import();
  ASSERT_EQ(trials_.size(), 1u);
  const model::Trial& trial = trials_[0];
  EXPECT_NO_THROW(model::ValidateTrial(trial));
  EXPECT_EQ(trial.seed, 7u);
  EXPECT_EQ(trial.outcome, "success");
  EXPECT_EQ(trial.actions, (std::vector<int>{2, 0, 0, 1, 1}));
  EXPECT_EQ(trial.prev_action, (std::vector<int>{2, 2, 2, 0, 0}));
  EXPECT_EQ(trial.segment, (std::vector<int>{-1, 0, 0, 1, 1}));
  EXPECT_EQ(trial.segment_succeeded, (std::vector<std::int8_t>{1, 1}));
  EXPECT_EQ(trial.dones, (std::vector<std::uint8_t>{0, 0, 0, 0, 1}));
  EXPECT_EQ(trial.rewards, (std::vector<float>{0, 0, 0, 0, 1}));
  EXPECT_EQ(trial.frame(3)[0], 37);
  EXPECT_EQ(trial.image_noise, 0);  // it is in the pictures already
  EXPECT_EQ(trial.light, 1.05);
  EXPECT_EQ(trial.plan_length, 2);
}

TEST_F(FromLog, AFailedSegmentDidNotSucceed) {
  {
    LogWriter log(path_);
    log.Write(Task());
    WriteRun(log, 7, -1, label_t::OUTCOME_FAILURE);
  }
  Import();
  ASSERT_EQ(trials_.size(), 1u);
  EXPECT_EQ(trials_[0].outcome, "failure");
  EXPECT_EQ(trials_[0].reason, "time");
  EXPECT_EQ(trials_[0].segment_succeeded, (std::vector<std::int8_t>{1, 0}));
  EXPECT_EQ(trials_[0].rewards.back(), -1);
}

TEST_F(FromLog, RepeatsAndFramesAfterTheEndChangeNothing) {
  {
    LogWriter log(path_);
    log.Write(Task());
    log.Write(Observation(7, 0));
    log.Write(Observation(7, 0));
    WriteRun(log, 7);
    log.Write(Observation(7, 4));
    log.Write(Label(7, 4));
    log.Write(Observation(7, 5));
  }
  Import();
  ASSERT_EQ(trials_.size(), 1u);
  EXPECT_EQ(trials_[0].frames(), 5);
}

action_status_t Status(std::int64_t frame, std::int64_t command, std::int8_t state,
                       std::int8_t outcome = label_t::OUTCOME_UNKNOWN) {
  action_status_t m{};
  m.episode_id = 7;
  m.frame = frame;
  m.executive_id = 1;
  m.command_id = command;
  m.action = static_cast<std::int32_t>(command) - 1;
  m.state = state;
  m.outcome = outcome;
  if (state == action_status_t::STATE_FAILED) m.reason = "reach";
  return m;
}

// CANCEL is a command with a number of its own; the action is still the second.
action_status_t Cancelled(std::int64_t frame) {
  action_status_t m = Status(frame, 3, action_status_t::STATE_CANCELLED);
  m.action = 1;
  return m;
}

/// A robot says no LABEL. Frames 1 and 2 are the first action's, 3 and 4 the second's.
class FromStatus : public FromLog {
 protected:
  void Write(const std::vector<action_status_t>& statuses,
             const std::vector<verdict_t>& verdicts = {}) {
    LogWriter log(path_);
    log.Write(Task());
    for (std::int64_t frame = 0; frame <= 4; ++frame) log.Write(Observation(7, frame));
    for (const action_status_t& status : statuses) log.Write(status);
    for (const verdict_t& verdict : verdicts) log.Write(verdict);
  }

  static constexpr std::int8_t kRuns = action_status_t::STATE_RUNNING;
  static constexpr std::int8_t kSucceeded = action_status_t::STATE_SUCCEEDED;
  static constexpr std::int8_t kEnded = action_status_t::STATE_ENDED;
};

TEST_F(FromStatus, AnActionBeginsOnThePictureThatEndedTheOneBefore) {
  Write({Status(0, 0, action_status_t::STATE_IDLE), Status(0, 1, kRuns), Status(1, 1, kRuns),
         Status(2, 1, kSucceeded), Status(2, 1, kSucceeded),
         Status(2, 9, action_status_t::STATE_REFUSED), Status(2, 2, kRuns),
         Status(4, 2, kSucceeded)});
  Import();
  ASSERT_EQ(trials_.size(), 1u);
  const model::Trial& trial = trials_[0];
  EXPECT_NO_THROW(model::ValidateTrial(trial));
  EXPECT_FALSE(trial.simulated);
  EXPECT_EQ(trial.seed, 7u);
  EXPECT_EQ(trial.outcome, "success");  // a whole plan was carried out, and nobody judges it
  EXPECT_EQ(trial.actions, (std::vector<int>{0, 0, 1, 1, 1}));
  EXPECT_EQ(trial.prev_action, (std::vector<int>{2, 2, 0, 0, 0}));
  EXPECT_EQ(trial.segment, (std::vector<int>{0, 0, 1, 1, 1}));
  EXPECT_EQ(trial.segment_succeeded, (std::vector<std::int8_t>{1, 1}));
  EXPECT_EQ(trial.rewards, (std::vector<float>{0, 0, 0, 0, 1}));
}

TEST_F(FromStatus, AFailedActionEndsTheTrialWithItsCause) {
  Write({Status(0, 1, kRuns), Status(2, 1, action_status_t::STATE_FAILED)});
  Import();
  ASSERT_EQ(trials_.size(), 1u);
  EXPECT_EQ(trials_[0].outcome, "failure");
  EXPECT_EQ(trials_[0].reason, "reach");
  EXPECT_EQ(trials_[0].frames(), 3);
  EXPECT_EQ(trials_[0].segment_succeeded, (std::vector<std::int8_t>{0}));
}

TEST_F(FromStatus, ARobotThatJudgesItsTaskIsBelieved) {
  Write({Status(0, 1, kRuns), Status(2, 1, kSucceeded, label_t::OUTCOME_SUCCESS)});
  Import();
  ASSERT_EQ(trials_.size(), 1u);
  EXPECT_EQ(trials_[0].outcome, "success");
  EXPECT_EQ(trials_[0].frames(), 3);
}

TEST_F(FromStatus, ACancelledActionIsNoTrial) {
  Write({Status(0, 1, kRuns), Status(2, 1, kSucceeded), Status(2, 2, kRuns), Cancelled(3)});
  EXPECT_EQ(Refusal(), "b was cancelled");
}

verdict_t Said(std::int64_t command, bool succeeded) {
  verdict_t m{};
  m.executive_id = 1;
  m.command_id = command;
  m.episode_id = 7;
  m.action = static_cast<std::int32_t>(command) - 1;
  m.succeeded = succeeded ? 1 : 0;
  return m;
}

TEST_F(FromStatus, APersonSaysWhatTheRobotCannotTell) {
  const std::vector<action_status_t> statuses = {Status(0, 1, kRuns), Status(2, 1, kEnded),
                                                 Status(2, 2, kRuns), Status(4, 2, kEnded)};
  Write(statuses, {Said(1, true), Said(1, true), Said(2, true), Said(2, false)});
  Import();
  ASSERT_EQ(trials_.size(), 1u);
  EXPECT_EQ(trials_[0].outcome, "success");
  EXPECT_EQ(trials_[0].segment_succeeded, (std::vector<std::int8_t>{1, 1})) << "the first word";
  EXPECT_EQ(trials_[0].frames(), 5);
}

TEST_F(FromStatus, WhatAPersonSaysFailedEndsTheTrial) {
  Write({Status(0, 1, kRuns), Status(2, 1, kEnded), Status(2, 2, kRuns), Status(4, 2, kEnded)},
        {Said(1, false)});
  Import();
  ASSERT_EQ(trials_.size(), 1u);
  EXPECT_EQ(trials_[0].outcome, "failure");
  EXPECT_EQ(trials_[0].reason, "");
  EXPECT_EQ(trials_[0].segment_succeeded, (std::vector<std::int8_t>{0}));
  EXPECT_EQ(trials_[0].frames(), 3);
}

TEST_F(FromStatus, NobodysWordIsNoWord) {
  Write({Status(0, 1, kRuns), Status(2, 1, kEnded)}, {Said(2, true)});
  EXPECT_EQ(Refusal(), "nobody said whether a worked: record with run --ask");
}

TEST_F(FromStatus, NobodyOverrulesARobotThatCanTell) {
  Write({Status(0, 1, kRuns), Status(2, 1, action_status_t::STATE_FAILED)}, {Said(1, true)});
  Import();
  ASSERT_EQ(trials_.size(), 1u);
  EXPECT_EQ(trials_[0].outcome, "failure");
}

TEST_F(FromStatus, ATrialThatDidNotEndIsRefused) {
  Write({Status(0, 1, kRuns), Status(2, 1, kSucceeded), Status(2, 2, kRuns)});
  EXPECT_EQ(Refusal(), "the trial did not end");
}

TEST_F(FromStatus, AnActionWhoseEndWasNotHeardIsNamed) {
  Write({Status(0, 1, kRuns), Status(2, 2, kRuns), Status(4, 2, kSucceeded)});
  EXPECT_EQ(Refusal(), "how a ended is missing");
}

TEST_F(FromStatus, FramesThatNobodySawAreNotMadeUp) {
  Write({Status(0, 1, kRuns), Status(std::int64_t{1} << 50, 1, kSucceeded)});
  EXPECT_EQ(Refusal(), "pictures of a are missing");
}

TEST_F(FromLog, AnEpisodeWithAGapIsRefused) {
  {
    LogWriter log(path_);
    log.Write(Task());
    WriteRun(log, 7, 3);
  }
  EXPECT_EQ(Refusal(), "frame 3 is missing");
}

TEST_F(FromLog, AMissingLabelIsRefused) {
  {
    LogWriter log(path_);
    log.Write(Task());
    for (std::int64_t frame = 0; frame <= 4; ++frame) {
      log.Write(Observation(7, frame));
      if (frame != 2) log.Write(Label(7, frame));
    }
  }
  EXPECT_EQ(Refusal(), "the label of frame 2 is missing");
}

TEST_F(FromLog, AnEpisodeThatDidNotEndIsRefused) {
  {
    LogWriter log(path_);
    log.Write(Task());
    WriteRun(log, 7, 4);
  }
  EXPECT_EQ(Refusal(), "the trial did not end");
}

TEST_F(FromLog, WithoutTaskOrLabelsNothingIsKept) {
  {
    LogWriter log(path_);
    WriteRun(log, 7);
  }
  EXPECT_EQ(Refusal(), "there is no TASK message");
}

TEST_F(FromLog, OfTwoRunsOfOneSceneTheFirstWholeOneIsKept) {
  {
    LogWriter log(path_);
    log.Write(Task());
    WriteRun(log, 7, 2);
    WriteRun(log, 8);
    WriteRun(log, 7);
    WriteRun(log, 7);
  }
  Import();
  ASSERT_EQ(trials_.size(), 2u);
  ASSERT_EQ(importer_.rows().size(), 4u);
  EXPECT_EQ(importer_.rows()[0].reason, "frame 2 is missing");
  EXPECT_EQ(importer_.rows()[2].outcome, "success");
  EXPECT_EQ(importer_.rows()[3].reason, "an episode numbered 7 is kept already");
}

// Simulated scenes go by their seed, whatever their episodes are called.
TEST_F(FromLog, ASimulatedSceneIsKnownByItsSeed) {
  {
    LogWriter log(path_);
    log.Write(Task());
    for (const std::int64_t episode : {7, 8}) {
      for (std::int64_t frame = 0; frame <= 4; ++frame) {
        log.Write(Observation(episode, frame));
        label_t label = Label(episode, frame);
        label.seed = 123;
        log.Write(label);
      }
    }
  }
  Import();
  ASSERT_EQ(trials_.size(), 1u);
  EXPECT_EQ(trials_[0].seed, 123u);
  ASSERT_EQ(importer_.rows().size(), 2u);
  EXPECT_EQ(importer_.rows()[1].reason, "this scene was recorded before and is kept already");
}

// The label of an old scene's last frame comes behind the first picture of the next scene.
TEST_F(FromLog, ALateLabelStillFindsItsRun) {
  {
    LogWriter log(path_);
    log.Write(Task());
    for (std::int64_t frame = 0; frame <= 4; ++frame) {
      log.Write(Observation(7, frame));
      if (frame < 4) log.Write(Label(7, frame));
    }
    log.Write(Observation(8, 0));
    log.Write(Label(7, 4));
  }
  Import();
  EXPECT_EQ(trials_.size(), 1u);
}

TEST_F(FromLog, BadMessagesAreCountedAndSkipped) {
  {
    LogWriter log(path_);
    log.Write(Task());
    log.WriteRaw("OBSERVATION", {1, 2, 3});
    log.WriteRaw("SOMETHING_ELSE", {1, 2, 3});
    observation_t wrong = Observation(7, 1);
    wrong.width = 9;
    log.Write(wrong);
    WriteRun(log, 7);
  }
  Import();
  EXPECT_EQ(trials_.size(), 1u);
  const std::map<std::string, std::int64_t> expected = {
      {"OBSERVATION: truncated", 1}, {"OBSERVATION: value data: wrong picture size", 1}};
  EXPECT_EQ(importer_.refused(), expected);
}

// A recording of a deployment with a key: the tag is no part of the message.
TEST_F(FromLog, TaggedMessagesAreReadWithoutTheirTags) {
  {
    LogWriter log(path_);
    MessageSigner signer(BusKey{{1}});
    const auto write = [&](const char* channel, auto message) {
      messages::SetCounts(message);
      std::vector<std::uint8_t> bytes = messages::CheckedEncode(message);
      signer.Sign(channel, &bytes);
      log.WriteRaw(channel, bytes);
    };
    write("TASK", Task());
    for (std::int64_t frame = 0; frame <= 4; ++frame) {
      write("OBSERVATION", Observation(7, frame));
      write("LABEL", Label(7, frame));
    }
  }
  Import();
  EXPECT_EQ(trials_.size(), 1u);
  EXPECT_TRUE(importer_.refused().empty());
}

TEST_F(FromLog, ACutTailCostsOnlyTheTail) {
  {
    LogWriter log(path_);
    log.Write(Task());
    WriteRun(log, 7);
    WriteRun(log, 8);
  }
  fs::resize_file(path_, fs::file_size(path_) - 10);
  Import();
  EXPECT_EQ(trials_.size(), 1u);
  EXPECT_EQ(damaged_, 1);
}

TEST_F(FromLog, DamageInTheMiddleIsSkipped) {
  {
    LogWriter log(path_);
    log.Write(Task());
    WriteRun(log, 7);
    log.WriteRaw("NOISE", std::vector<std::uint8_t>(100, 7));
    WriteRun(log, 8);
  }
  // The noise's own header announces two gigabytes now.
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(file)), {});
  file.seekp(static_cast<std::streamoff>(bytes.find("NOISE")) - 4);
  file.write("\x7f\xff\xff\xff", 4);
  file.close();
  Import();
  EXPECT_EQ(trials_.size(), 2u);
  EXPECT_EQ(damaged_, 1);
}

TEST_F(FromLog, WhatIsNoLogIsAnError) {
  EXPECT_THROW(EventLog("no/such/file.lcmlog"), ExitError);
  std::ofstream(path_) << "this is not a log, however long it may be and whatever it says";
  try {
    EventLog log(path_);
    FAIL() << "no error";
  } catch (const ExitError& error) {
    EXPECT_EQ(error.code(), kExitDataFile);
  }
}

// Seeds kept for evaluation never enter a data set.
TEST_F(FromLog, TheSinksRefusalIsARow) {
  {
    LogWriter log(path_);
    log.Write(Task());
    for (std::int64_t frame = 0; frame <= 4; ++frame) {
      log.Write(Observation(7, frame));
      label_t label = Label(7, frame);
      label.seed = 2'000'000;
      log.Write(label);
    }
  }
  LogImporter strict([](const model::Trial& trial) { model::ValidateTrial(trial); });
  EventLog log(path_);
  LogEvent event;
  while (log.Next(event)) strict.Take(event);
  strict.EndOfLog();
  ASSERT_EQ(strict.rows().size(), 1u);
  EXPECT_EQ(strict.rows()[0].outcome, "refused");
  EXPECT_NE(strict.rows()[0].reason.find("999,999"), std::string::npos);
}

// A robot's episodes may be called anything: no scene is kept for evaluation by their ids.
TEST_F(FromLog, IdsOfARobotsEpisodesAreNoSeeds) {
  constexpr std::int64_t kLong = 7'000'000'000'000'000'123;
  {
    LogWriter log(path_);
    log.Write(Task());
    for (const std::int64_t episode : {std::int64_t{2'000'000}, std::int64_t{7}, kLong})
      WriteRun(log, episode);
  }
  Import();
  ASSERT_EQ(trials_.size(), 3u);
  for (const model::Trial& trial : trials_) {
    EXPECT_FALSE(trial.simulated);
    EXPECT_NO_THROW(model::ValidateTrial(trial));
  }
  EXPECT_EQ(trials_[0].seed, 2'000'000u);
  EXPECT_EQ(trials_[1].seed, 7u);
  EXPECT_LE(trials_[2].seed, model::kLastRecordedNumber);
  EXPECT_EQ(importer_.rows()[2].episode_id, kLong);
}

}  // namespace
}  // namespace prospect::services
