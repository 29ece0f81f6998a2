// Videos, written and read again.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "base/disk_error.h"
#include "model/dataset.h"
#include "report/video_reader.h"
#include "report/video_writer.h"
#include "report/whole_mp4.h"
#include "tests/unit/model/test_folder.h"
#include "tests/unit/report/ink.h"

namespace prospect::report {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 12, kWidth = 64, kHeight = 48;

// Red rises from frame to frame; there is no blue.
sim::Image FrameOf(int i) {
  sim::Image image = Plain(kWidth, kHeight, 0);
  for (std::size_t at = 0; at < image.rgb.size(); at += 3)
    image.rgb[at] = static_cast<std::uint8_t>(20 * i);
  return image;
}

class Videos : public ::testing::TestWithParam<VideoFormat> {
 protected:
  std::string Path() const {
    return folder_ / (GetParam() == VideoFormat::kMp4 ? "film.mp4" : "film.avi");
  }
  void Write(const std::string& path) const {
    VideoWriter video(path, 25, kWidth, kHeight, GetParam());
    for (int i = 0; i < kFrames; ++i) video.Add(FrameOf(i));
    video.Finish();
  }

  model::TestFolder folder_;
};

TEST_P(Videos, ShowWhatWasWritten) {
  Write(Path());
  VideoReader video(Path());
  EXPECT_NEAR(video.frames_per_second(), 25, 0.01);
  EXPECT_EQ(video.frame_count(), kFrames);
  EXPECT_EQ(FramesOfVideo(Path()), kFrames);
  int frames = 0;
  for (std::vector<std::uint8_t> rgb; video.Next(); ++frames) {
    ASSERT_TRUE(video.Picture(kWidth, kHeight, &rgb));
    EXPECT_NEAR(rgb[0], 20 * frames, 12) << "red";
    EXPECT_LT(rgb[2], 30) << "blue";
  }
  EXPECT_EQ(frames, kFrames);
}

TEST_P(Videos, TakeTheirNameWhenTheyAreWhole) {
  {
    VideoWriter video(Path(), 25, kWidth, kHeight, GetParam());
    video.Add(FrameOf(0));
    EXPECT_FALSE(fs::exists(Path()));
  }
  EXPECT_TRUE(fs::is_empty(folder_.path())) << "nothing is left of it";
}

TEST_P(Videos, HavePicturesOfOneSize) {
  VideoWriter video(Path(), 25, kWidth, kHeight, GetParam());
  EXPECT_THROW(video.Add(Plain(kWidth, kHeight + 2, 0)), std::logic_error);
  EXPECT_THROW(video.Add(Plain(kHeight, kWidth, 0)), std::logic_error);
}

TEST_P(Videos, NeedAFolder) {
  EXPECT_THROW(VideoWriter(folder_ / "none/film", 25, kWidth, kHeight, GetParam()),
               base::DiskError);
}

INSTANTIATE_TEST_SUITE_P(Formats, Videos,
                         ::testing::Values(VideoFormat::kMp4, VideoFormat::kMotionJpeg));

std::string Bytes(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(WholeMp4, IsNotOneThatWasCutOff) {
  const model::TestFolder folder;
  VideoWriter video(folder / "film.mp4", 25, kWidth, kHeight);
  for (int i = 0; i < kFrames; ++i) video.Add(FrameOf(i));
  video.Finish();
  EXPECT_TRUE(IsWholeMp4(folder / "film.mp4"));
  const std::string bytes = Bytes(folder / "film.mp4");
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
    std::ofstream(folder / "cut.mp4", std::ios::binary) << bytes.substr(0, length);
    EXPECT_FALSE(IsWholeMp4(folder / "cut.mp4")) << length;
  }
  EXPECT_FALSE(IsWholeMp4(folder / "none.mp4"));
}

TEST(VideoReader, NamesWhatItCannotRead) {
  const model::TestFolder folder;
  std::ofstream(folder / "text.avi") << "nothing";
  EXPECT_THROW(VideoReader(folder / "text.avi"), model::DataError);
  EXPECT_THROW(VideoReader(folder / "none.avi"), model::DataError);
  EXPECT_EQ(FramesOfVideo(folder / "text.avi"), 0);
}

}  // namespace
}  // namespace prospect::report
