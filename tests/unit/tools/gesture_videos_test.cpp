// The writer of simulated suturing trials in the layout of JIGSAWS.

#include "tools/collect/gesture_videos.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include "report/image_edit.h"
#include "report/video_reader.h"
#include "sim/suturing/gestures.h"
#include "tools/collect/collector.h"
#include "tools/collect/gesture_trial.h"

namespace prospect::tools {
namespace {

namespace fs = std::filesystem;

std::string Text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Width and height in the main header of an AVI file.
std::pair<int, int> AviSize(const fs::path& path) {
  const std::string head = Text(path).substr(64, 8);
  const auto number = [&](std::size_t at) {
    return static_cast<unsigned char>(head[at]) + 256 * static_cast<unsigned char>(head[at + 1]);
  };
  return {number(0), number(4)};
}

// Two small trials, made once; tests that change them work on a copy.
class GestureVideosTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made_ = testing::TempDir() + "prospect_gestures_made_" + std::to_string(getpid());
    fs::remove_all(made_);
    summary_ = CollectGestureVideos(Options(made_));
  }
  static void TearDownTestSuite() { fs::remove_all(made_); }

  static cli::CollectOptions Options(const std::string& out) {
    cli::CollectOptions options;
    options.trials = 2;
    options.seed = 40;
    options.out = out;
    options.frames_per_second = 2;
    options.width = 64;
    options.height = 48;
    return options;
  }

  GestureVideosTest()
      : mine_(testing::TempDir() + "prospect_gestures_mine_" + std::to_string(getpid())),
        options_(Options(mine_)) {
    fs::remove_all(mine_);
  }
  ~GestureVideosTest() override { fs::remove_all(mine_); }

  void CopyMade() { fs::copy(made_, mine_, fs::copy_options::recursive); }

  static fs::path Root(const std::string& out) { return fs::path(out) / "Suturing"; }
  static fs::path Video(const std::string& out, const std::string& trial, int eye = 1) {
    return Root(out) / "video" / ("Suturing_" + trial + "_capture" + std::to_string(eye) + ".avi");
  }
  static fs::path Transcription(const std::string& out, const std::string& trial) {
    return Root(out) / "transcriptions" / ("Suturing_" + trial + ".txt");
  }

  static std::string made_;
  static GestureVideoSummary summary_;
  std::string mine_;
  cli::CollectOptions options_;
};

std::string GestureVideosTest::made_;
GestureVideoSummary GestureVideosTest::summary_;

TEST(GestureTrialNames, AreJigsaws39) {
  std::set<std::string> names;
  for (int i = 0; i < 39; ++i) names.insert(GestureTrialName(i));
  EXPECT_EQ(names.size(), 39u);
  EXPECT_EQ(GestureTrialName(0), "B001");
  EXPECT_EQ(GestureTrialName(38), "I005");
  EXPECT_EQ(names.count("H001"), 1u);
  EXPECT_EQ(names.count("H002"), 0u);
  EXPECT_THROW(GestureTrialName(39), std::out_of_range);
}

TEST(GestureTrials, TranscriptionCoversTheFramesWithoutGapOrOverlap) {
  sim::TaskOptions options;
  options.frames_per_second = 5;
  sim::SuturingTask task(options);
  int shown = 0;
  const GestureTrial trial =
      PlayGestureTrial(&task, 12, 0, [&shown](int frame) { EXPECT_EQ(frame, ++shown); });
  EXPECT_EQ(shown, trial.frames);
  ASSERT_GE(trial.spans.size(), 18u);
  EXPECT_GT(trial.spans.front().first, 1);  // the first frames have no gesture
  for (std::size_t i = 0; i < trial.spans.size(); ++i) {
    EXPECT_LE(trial.spans[i].first, trial.spans[i].last);
    if (i > 0) {
      EXPECT_EQ(trial.spans[i].first, trial.spans[i - 1].last + 1);
    }
  }
  EXPECT_LT(trial.spans.back().last, trial.frames);
  EXPECT_EQ(trial.spans.front().gesture, static_cast<int>(sim::kReachRight));
  EXPECT_EQ(trial.spans.back().gesture, static_cast<int>(sim::kDrop));
}

TEST(GestureTrials, AttemptsDifferAndRepeat) {
  sim::TaskOptions options;
  options.frames_per_second = 2;
  sim::SuturingTask task(options);
  const std::string first = TranscriptionText(PlayGestureTrial(&task, 3, 0, {}));
  EXPECT_NE(first, TranscriptionText(PlayGestureTrial(&task, 3, 1, {})));
  EXPECT_EQ(first, TranscriptionText(PlayGestureTrial(&task, 3, 0, {})));
}

TEST(GestureTrials, LinesAreThoseOfJigsaws) {
  GestureTrial trial;
  trial.spans = {{3, 9, 0}, {10, 22, 10}};
  EXPECT_EQ(TranscriptionText(trial), "3 9 G1 \n10 22 G11 \n");
}

TEST_F(GestureVideosTest, WritesTheLayout) {
  EXPECT_EQ(summary_.trials, 2);
  EXPECT_EQ(summary_.kept, 0);
  EXPECT_NE(Text(fs::path(made_) / "README.txt").find("SIMULATED"), std::string::npos);
  EXPECT_NE(Text(Root(made_) / "simulated.json").find("\"simulated\": true"), std::string::npos);
  const std::string meta = Text(Root(made_) / "meta_file_Suturing.txt");
  EXPECT_NE(meta.find("Suturing_B002\tSIMULATED\t"), std::string::npos);
  EXPECT_EQ(std::count(meta.begin(), meta.end(), '\n'), 2);
}

TEST_F(GestureVideosTest, VideosHoldAllFramesOfTheirTranscriptions) {
  std::int64_t frames = 0;
  for (const char* trial : {"B001", "B002"}) {
    EXPECT_EQ(AviSize(Video(made_, trial)), (std::pair<int, int>(64, 48)));
    report::VideoReader video(Video(made_, trial).string());
    EXPECT_NEAR(video.frames_per_second(), 2, 1e-3);
    int count = 0;
    while (video.Next()) ++count;
    std::istringstream lines(Text(Transcription(made_, trial)));
    int first = 0, last = 0;
    std::string gesture;
    while (lines >> first >> last >> gesture) EXPECT_LE(last, count);
    EXPECT_GE(last, count - 3);  // it ends a second after the last gesture
    frames += count;
  }
  EXPECT_EQ(frames, summary_.frames);
}

TEST_F(GestureVideosTest, AFrameShowsWhatTheTranscriptionSays) {
  sim::TaskOptions options;
  options.surgeon = 0;
  options.frames_per_second = 2;
  sim::SuturingTask task(options);
  std::vector<sim::Image> pictures;
  const GestureTrial trial = PlayGestureTrial(
      &task, options_.seed, 0, [&](int) { pictures.push_back(task.Render(64, 48)); });
  EXPECT_EQ(TranscriptionText(trial), Text(Transcription(made_, "B001")));
  report::VideoReader video(Video(made_, "B001").string());
  sim::Image shown{64, 48, {}};
  for (const sim::Image& picture : pictures) {
    ASSERT_TRUE(video.Next());
    ASSERT_TRUE(video.Picture(64, 48, &shown.rgb));
    ASSERT_LT(255 * report::MeanAbsoluteError(shown, picture), 7);  // noise and compression
  }
}

TEST_F(GestureVideosTest, TheSameSeedGivesTheSameBytes) {
  options_.trials = options_.jobs = 1;
  CollectGestureVideos(options_);
  const std::string first = Text(Video(made_, "B001"));
  EXPECT_GT(first.size(), 10'000u);
  EXPECT_TRUE(first == Text(Video(mine_, "B001")));
  EXPECT_FALSE(first == Text(Video(made_, "B002")));
}

TEST_F(GestureVideosTest, ResumesWithTheTrialsThatAreMissing) {
  CopyMade();
  EXPECT_THROW(CollectGestureVideos(options_), CollectUsageError);  // without --resume
  fs::remove(Transcription(mine_, "B001"));                         // as if killed before it
  std::ofstream(Video(mine_, "B001"), std::ios::trunc) << "half";
  options_.resume = true;
  const GestureVideoSummary summary = CollectGestureVideos(options_);
  EXPECT_EQ(summary.kept, 1);
  EXPECT_EQ(summary.frames, summary_.frames);
  EXPECT_TRUE(Text(Video(mine_, "B001")) == Text(Video(made_, "B001")));
}

TEST_F(GestureVideosTest, RefusesFoldersOfOtherOptions) {
  CopyMade();
  options_.resume = true;
  options_.seed = 41;
  EXPECT_THROW(CollectGestureVideos(options_), CollectUsageError);
}

TEST_F(GestureVideosTest, LeavesRecordedTrialsAlone) {
  fs::create_directories(Root(mine_) / "video");
  std::ofstream(Video(mine_, "B001")) << "a recorded one";
  EXPECT_THROW(CollectGestureVideos(options_), CollectUsageError);
  EXPECT_EQ(Text(Video(mine_, "B001")), "a recorded one");
}

TEST_F(GestureVideosTest, RefusesImpossibleOptions) {
  for (const auto& change : std::vector<std::function<void(cli::CollectOptions*)>>{
           [](auto* o) { o->trials = 40; }, [](auto* o) { o->trials = 0; },
           [](auto* o) { o->seed = 999'999; }, [](auto* o) { o->frames_per_second = 4; },
           [](auto* o) { o->width = 8; }}) {
    cli::CollectOptions options = options_;
    change(&options);
    EXPECT_THROW(CollectGestureVideos(options), CollectUsageError);
  }
  EXPECT_FALSE(fs::exists(mine_));
}

TEST_F(GestureVideosTest, TheRightEyeWhenAskedFor) {
  options_.trials = 1;
  options_.right_eye = true;
  CollectGestureVideos(options_);
  EXPECT_TRUE(Text(Video(mine_, "B001")) == Text(Video(made_, "B001")));
  ASSERT_TRUE(fs::exists(Video(mine_, "B001", 2)));
  EXPECT_FALSE(Text(Video(mine_, "B001", 2)) == Text(Video(mine_, "B001")));
}

}  // namespace
}  // namespace prospect::tools
