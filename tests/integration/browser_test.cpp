// Whether a browser plays the videos that Prospect writes: Chromium opens a page with both kinds
// and tells how far it came. Skipped where there is no Chromium.

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "report/episode_video.h"
#include "report/video_writer.h"

namespace prospect {
namespace {

constexpr int kFrames = 20, kFramesPerSecond = 10;

sim::Image PictureOf(int width, int height, int tick) {
  sim::Image picture{width, height, {}};
  picture.rgb.resize(static_cast<std::size_t>(width) * height * 3);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    picture.rgb[i] = static_cast<std::uint8_t>(i / 7 + static_cast<std::size_t>(tick) * 5);
  return picture;
}

void WriteEpisode(const std::string& path) {
  agent::EpisodeRecord record;
  record.frames_per_second = kFramesPerSecond;
  for (int i = 0; i < kFrames; ++i) record.frames.push_back(PictureOf(64, 64, i));
  report::WriteEpisodeVideo(record, path);
}

// Of an odd size, as a person may ask for.
void WriteView(const std::string& path) {
  report::VideoWriter video(path, kFramesPerSecond, 321, 241);
  for (int i = 0; i < kFrames; ++i) video.Add(PictureOf(321, 241, i));
  video.Finish();
}

// A page that plays a video and says its name, how far it came and what was wrong.
void WritePage(const std::string& path, const std::string& video) {
  std::ofstream(path) << "<body><p id=said>nothing</p><video id=video muted src=" << video
                      << R"(></video><script>
const video = document.getElementById('video');
const tell = () => document.getElementById('said').textContent =
    `seconds ${video.currentTime}, size ${video.videoWidth}x${video.videoHeight}, ` +
    (video.error ? `error ${video.error.code}` : 'no error');
for (const event of ['loadeddata', 'timeupdate', 'ended', 'error'])
  video.addEventListener(event, tell);
video.play().catch(tell);
</script>)";
}

std::string Output(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> part{};
  for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    text.append(part.data(), n);
  pclose(pipe);
  return text;
}

// The page after the video had the time to be played; virtual time does not wait for clocks.
std::string Browsed(const std::string& folder, const std::string& page) {
  return Output(
      "timeout -k 5 90 chromium --headless --no-sandbox --disable-gpu --disable-quic "
      "--no-first-run --disable-background-networking --disable-component-update --disable-sync "
      "--user-data-dir='" +
      folder + "/profile' --virtual-time-budget=20000 --dump-dom 'file://" + page +
      "' 2>/dev/null");
}

class Browser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v chromium >/dev/null") != 0) GTEST_SKIP() << "no chromium here";
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  void ExpectPlayed(const std::string& video, const std::string& size) const {
    WritePage(folder_ + "/page.html", video);
    const std::string page = Browsed(folder_, folder_ + "/page.html");
    EXPECT_NE(page.find("seconds 2, size " + size + ", no error"), std::string::npos) << page;
  }
  const std::string folder_ = testing::TempDir() + "browser_" + std::to_string(getpid());
};

TEST_F(Browser, PlaysAnEpisode) {
  WriteEpisode(folder_ + "/episode.mp4");
  ExpectPlayed("episode.mp4", "448x448");
}

TEST_F(Browser, PlaysAView) {
  WriteView(folder_ + "/view.mp4");
  ExpectPlayed("view.mp4", "320x240");
}

}  // namespace
}  // namespace prospect
