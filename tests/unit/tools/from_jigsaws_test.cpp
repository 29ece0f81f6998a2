// Folders in the layout of JIGSAWS, made here, to data sets.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "model/dataset.h"
#include "report/video_writer.h"
#include "tests/unit/model/test_folder.h"
#include "tools/recordings/from_video.h"

namespace prospect::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 40;

using Names = std::set<std::string>;

Names NamesOf(const model::TrialFile& file) {
  Names names;
  for (std::size_t i = 0; i < file.size(); ++i) names.insert(file.ReadLabels(i).name);
  return names;
}

std::size_t IndexOf(const model::TrialFile& file, const std::string& name) {
  std::size_t i = 0;
  while (file.ReadLabels(i).name != name) ++i;
  return i;
}

class FromJigsaws : public ::testing::Test {
 protected:
  FromJigsaws() {
    fs::create_directories(Folder("transcriptions"));
    fs::create_directories(Folder("video"));
    fs::create_directories(Folder("kinematics/AllGestures"));
    std::ofstream(Folder("meta_file_Suturing.txt")) << "Suturing_B001\tN\t13\n";
    options_.folder = folder_ / "Suturing";
    options_.out = folder_ / "out.h5";
    options_.every = 5;
  }
  std::string Folder(const std::string& name) const { return folder_ / ("Suturing/" + name); }

  void Transcribe(const std::string& name, const std::string& text) const {
    std::ofstream(Folder("transcriptions/" + name + ".txt")) << text;
  }
  /// Red rises from frame to frame; the left half is blue, so that channels and sides show.
  void Film(const std::string& name, int frames = kFrames) const {
    report::VideoWriter video(Folder("video/" + name + "_capture1.avi"), 30, 64, 48,
                              report::VideoFormat::kMotionJpeg);
    for (int i = 1; i <= frames; ++i) {
      sim::Image picture{64, 48, {}};
      for (int at = 0; at < 64 * 48; ++at) {
        const std::uint8_t blue = at % 64 < 32 ? 200 : 0;
        picture.rgb.insert(picture.rgb.end(), {static_cast<std::uint8_t>(5 * i), 0, blue});
      }
      video.Add(picture);
    }
    video.Finish();
  }
  void Whole(const std::string& name) const {
    Transcribe(name, "3 12 G1\n15 22 G2\n23 37 G6\n");
    Film(name);
  }
  ConversionReport Convert() {
    said_.clear();
    const auto say = [this](const std::string& line) { said_ += line + "\n"; };
    return FromVideo(tasks::ReadTaskFile(PROSPECT_ROOT "/tasks/suturing.yaml"), options_, say,
                     &stop_);
  }
  /// Files of the folder beside the task's.
  int FilesBeside() const {
    int files = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      files += entry.is_regular_file() ? 1 : 0;
    }
    return files;
  }

  model::TestFolder folder_;
  FromVideoOptions options_;
  std::atomic<bool> stop_{false};
  std::string said_;
};

TEST_F(FromJigsaws, WholeTrials) {
  for (const char* name : {"Suturing_B001", "Suturing_B002", "Suturing_C001"}) Whole(name);
  std::ofstream(Folder("video/Suturing_B001_capture2.avi")) << "the right camera is not read";
  const ConversionReport report = Convert();
  EXPECT_EQ(said_, "");
  EXPECT_EQ(report.trials, 3U);
  EXPECT_EQ(report.left_out + report.repaired, 0U);
  const model::TrialFile file(options_.out);
  EXPECT_EQ(NamesOf(file), (Names{"Suturing_B001", "Suturing_B002", "Suturing_C001"}));
  const model::Trial trial = file.Read(IndexOf(file, "Suturing_B001"));
  EXPECT_EQ(trial.name, "Suturing_B001");
  EXPECT_EQ(trial.task, "suturing");
  EXPECT_EQ(trial.width, 128);
  EXPECT_EQ(trial.height, 96);
  // Frames 3 8 13 15 18 23 28 33 37: every fifth, each gesture's first, the last.
  EXPECT_EQ(trial.actions, (std::vector<int>{0, 0, 0, 1, 1, 5, 5, 5, 5}));
  EXPECT_NEAR(trial.tick_seconds, 5.0 / 30, 1e-6);
  const int numbers[] = {3, 8, 13, 15, 18, 23, 28, 33, 37};
  for (int i = 0; i < 9; ++i) {
    const std::uint8_t* right = trial.frame(i) + (48 * 128 + 96) * 3;
    const std::uint8_t* left = trial.frame(i) + (48 * 128 + 32) * 3;
    EXPECT_NEAR(right[0], 5 * numbers[i], 6) << "red of frame " << numbers[i];
    EXPECT_LT(right[2], 20);
    EXPECT_GT(left[2], 150) << "blue on the left";
  }
  EXPECT_EQ(report.frames, 27);
  const model::DataSetSummary summary = model::Summarize(file);
  EXPECT_EQ(summary.train, 1U);
  EXPECT_EQ(summary.valid, 1U);
  EXPECT_EQ(summary.test, 1U);
  EXPECT_EQ(FilesBeside(), 1);
}

TEST_F(FromJigsaws, AUserIsHeldOut) {
  for (const char* name : {"Suturing_B001", "Suturing_C001", "Suturing_C002"}) Whole(name);
  options_.held_out = {"Suturing_C*"};
  Convert();
  const model::TrialFile file(options_.out);
  EXPECT_NE(file.part(IndexOf(file, "Suturing_B001")), model::Split::kTest);
  EXPECT_EQ(file.part(IndexOf(file, "Suturing_C001")), model::Split::kTest);
  EXPECT_EQ(file.part(IndexOf(file, "Suturing_C002")), model::Split::kTest);
  options_.held_out = {"D001"};
  options_.out = folder_ / "next.h5";
  EXPECT_THROW(Convert(), std::invalid_argument);
  EXPECT_FALSE(fs::exists(options_.out));
}

TEST_F(FromJigsaws, EachFaultIsALine) {
  Whole("Suturing_B001");
  Whole("Suturing_B002");
  Whole("Suturing_B003");
  Transcribe("Suturing_C001", "1 9 G1\n");  // no video
  Film("Suturing_C002");                    // no transcription
  Whole("Suturing_C003");
  Transcribe("Suturing_C003", "1 9 G1\n10 19 G77\n");
  Whole("Suturing_C004");
  std::ofstream(Folder("video/Suturing_C004_capture1.avi")) << "not a video";
  Whole("Suturing_C005");
  Transcribe("Suturing_C005", "80 90 G1\n");  // begins beyond the video
  Whole("Suturing_D001");
  Transcribe("Suturing_D001", "1 30 G1\n21 60 G2\n70 80 G3\n");  // overlaps, and goes beyond
  Whole("Suturing_D1");
  const ConversionReport report = Convert();
  EXPECT_EQ(report.trials, 5U);
  EXPECT_EQ(report.left_out, 5U);
  EXPECT_EQ(report.repaired, 1U);
  EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 7) << said_;
  for (const char* line :
       {"Suturing_C001: left out: ", "Suturing_C001_capture1.avi: is missing",
        "Suturing_C002: left out: ", "Suturing_C002.txt: is missing", "Suturing_C003: left out: ",
        "there is no action 'G77'", "Suturing_C004: left out: ", "is no video",
        "Suturing_C005: left out: ", "ends before its first action",
        "line 2: overlaps the action before by 10 frames",
        "goes 40 frames beyond the recording's 40; cut there, actions left out: 1"}) {
    EXPECT_NE(said_.find(line), std::string::npos) << line << " is not in\n" << said_;
  }
  const model::TrialFile file(options_.out);
  EXPECT_EQ(NamesOf(file), (Names{"Suturing_B001", "Suturing_B002", "Suturing_B003",
                                  "Suturing_D001", "Suturing_D1"}));
  const model::Trial repaired = file.Read(IndexOf(file, "Suturing_D001"));
  EXPECT_EQ(repaired.actions, (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1}));
}

TEST_F(FromJigsaws, AVideoThatBreaksOffCutsTheTranscription) {
  for (const char* name : {"Suturing_B001", "Suturing_B002", "Suturing_B003"}) Whole(name);
  const std::string video = Folder("video/Suturing_B002_capture1.avi");
  fs::resize_file(video, fs::file_size(video) / 2);
  const ConversionReport report = Convert();
  EXPECT_EQ(report.trials + report.left_out, 3U);
  EXPECT_EQ(report.repaired + report.left_out, 1U) << said_;
  EXPECT_NE(said_.find("Suturing_B002: "), std::string::npos) << said_;
}

TEST_F(FromJigsaws, NothingRemainsWhereNothingCanBeUsed) {
  EXPECT_THROW(Convert(), model::DataError) << "empty";
  Transcribe("Suturing_B001", "1 9 G1\n");
  EXPECT_THROW(Convert(), model::DataError);
  EXPECT_EQ(FilesBeside(), 0);
  options_.folder = folder_ / "none";
  EXPECT_THROW(Convert(), model::DataError);
}

TEST_F(FromJigsaws, WhenToldToStopNothingRemains) {
  Whole("Suturing_B001");
  stop_ = true;
  EXPECT_THROW(Convert(), Interrupted);
  EXPECT_EQ(FilesBeside(), 0);
}

}  // namespace
}  // namespace prospect::tools
