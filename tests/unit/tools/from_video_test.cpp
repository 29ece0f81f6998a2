// Folders of videos with a CSV each to data sets.
#include "tools/recordings/from_video.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/exit_error.h"
#include "model/dataset.h"
#include "report/video_writer.h"
#include "tests/unit/model/test_folder.h"
#include "tests/unit/tools/recorded_trials.h"

namespace prospect::tools {
namespace {

namespace fs = std::filesystem;

class FromVideoTest : public ::testing::Test {
 protected:
  FromVideoTest() {
    fs::create_directories(videos_);
    options_.folder = videos_;
    options_.out = folder_ / "out.h5";
  }

  /// Enlarged and lossy, as an episode's video is.
  void Film(const std::string& name, const model::Trial& trial) const {
    report::VideoWriter video(videos_ + "/" + name + ".mp4", 1 / trial.tick_seconds,
                              4 * trial.width, 4 * trial.height);
    for (int i = 0; i < trial.frames(); ++i) {
      sim::Image picture{4 * trial.width, 4 * trial.height, {}};
      for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
          const std::uint8_t* pixel = trial.frame(i) + (y / 4 * trial.width + x / 4) * 3;
          picture.rgb.insert(picture.rgb.end(), pixel, pixel + 3);
        }
      }
      video.Add(picture);
    }
    video.Finish();
  }
  void Table(const std::string& name, const std::string& rows) const {
    std::ofstream(videos_ + "/" + name + ".csv") << rows;
  }
  void Whole(const std::string& name) const {
    Film(name, BinTrial(1, false));
    Table(name, "0.1,0.4,open,1\n0.5,0.8,2,1\n");
  }
  ConversionReport Convert() {
    said_.clear();
    const auto say = [this](const std::string& line) { said_ += line + "\n"; };
    return FromVideo(BinTask(), options_, say, &stop_);
  }

  model::TestFolder folder_;
  std::string videos_ = folder_ / "videos";
  FromVideoOptions options_;
  std::atomic<bool> stop_{false};
  std::string said_;
};

TEST_F(FromVideoTest, LabelsAreThoseOfTheEpisode) {
  const model::Trial good = BinTrial(1, false), bad = BinTrial(2, true);
  Film("good", good);
  Table("good", "start,end,action,succeeded\n0.1,0.4,open,1\n0.5,0.8,\"put(cup,right)\",1\n");
  Film("bad", bad);
  Table("bad", "0.1,0.4,0,yes\n0.5,0.8,\"put(cup,left)\",no,\"fell, \"\"loudly\"\"\"\n");
  const ConversionReport report = Convert();
  EXPECT_EQ(said_, "");
  EXPECT_EQ(report.trials, 2U);
  const model::TrialFile file(options_.out);
  ASSERT_EQ(file.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const model::Trial trial = file.Read(i);
    const model::Trial& episode = trial.name == "good" ? good : bad;
    SCOPED_TRACE(trial.name);
    ExpectSameLabels(trial, episode);
    EXPECT_EQ(trial.width, 48);
    EXPECT_EQ(trial.height, 32);
    for (int frame = 0; frame < trial.frames(); ++frame) {
      EXPECT_NEAR(trial.frame(frame)[0], episode.frame(frame)[0], 16) << "red of " << frame;
    }
  }
}

TEST_F(FromVideoTest, EveryFaultNamesFileAndLine) {
  Whole("whole");
  Film("order", BinTrial(1, false));
  Table("order", "0.5,0.8,2,1\n0.1,0.6,open,1\n");  // out of order, and they overlap by a frame
  Film("late", BinTrial(1, true));
  Table("late", "0.1,0.4,open,1\n0.5,30,2,0,fell\n");
  Film("unknown", BinTrial(1, false));
  Table("unknown", "0.1,0.4,open,1\n0.5,0.8,put(cup),1\n");
  Film("short", BinTrial(1, false));
  Table("short", "0.1,0.4,open,1\n");
  Film("lonely", BinTrial(1, false));
  Table("blind", "0.1,0.4,open,0\n");
  const ConversionReport report = Convert();
  EXPECT_EQ(report.trials, 3U) << said_;
  EXPECT_EQ(report.repaired, 2U) << said_;
  EXPECT_EQ(report.left_out, 4U) << said_;
  for (const char* line :
       {"order.csv: line 2: begins before the row above it", "line 1: overlaps the action before",
        "late.csv: goes 292 frames beyond the recording's 9; cut there",
        "unknown: left out: ", "unknown.csv: line 2: there is no action 'put(cup)'",
        "short.csv: line 1: the last of 1 actions succeeded, and a plan has 2",
        "lonely: left out: ", "lonely.csv: is missing", "blind.mp4: is missing"}) {
    EXPECT_NE(said_.find(line), std::string::npos) << line << " is not in\n" << said_;
  }
}

TEST_F(FromVideoTest, FewerFramesAreKeptOfAFastVideo) {
  model::Trial fast = BinTrial(1, false, 12);
  fast.tick_seconds = 1 / 30.0;
  Film("fast", fast);
  Table("fast", "0.0333,0.4,open,1\n0.4333,0.8,2,1\n");
  Convert();
  const model::Trial trial = model::TrialFile(options_.out).Read(0);
  EXPECT_NEAR(trial.tick_seconds, 0.1, 1e-9);
  // Of frames 0 to 24, of 30 a second: one a tick (0 is before the first action, 1 its first),
  // each action's first, and the last.
  EXPECT_EQ(trial.segment, (std::vector<int>{-1, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1}));
}

TEST_F(FromVideoTest, PartsGoByNames) {
  for (const char* name : {"monday_1", "monday_2", "tuesday_1"}) Whole(name);
  options_.held_out = {"monday*"};
  Convert();
  const model::TrialFile file(options_.out);
  for (std::size_t i = 0; i < file.size(); ++i) {
    const bool monday = file.ReadLabels(i).name.rfind("monday", 0) == 0;
    EXPECT_EQ(file.part(i) == model::Split::kTest, monday);
  }
}

TEST_F(FromVideoTest, NothingRemainsWhereNothingCanBeUsed) {
  EXPECT_THROW(Convert(), model::DataError) << "empty";
  Table("blind", "0.1,0.4,open,0\n");
  EXPECT_THROW(Convert(), model::DataError);
  options_.folder = folder_ / "none";
  EXPECT_THROW(Convert(), model::DataError);
  EXPECT_FALSE(fs::exists(options_.out));
  options_.folder = videos_;
  Whole("whole");
  stop_ = true;
  EXPECT_THROW(Convert(), Interrupted);
  EXPECT_FALSE(fs::exists(options_.out));
}

TEST_F(FromVideoTest, TwoVideosOfOneNameAreRefused) {
  Whole("twice");
  fs::copy(videos_ + "/twice.mp4", videos_ + "/twice.avi");
  EXPECT_THROW(Convert(), model::DataError);
}

}  // namespace
}  // namespace prospect::tools
