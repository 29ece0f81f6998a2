#include "tools/evaluate/scene_video.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "report/whole_mp4.h"
#include "sim/task_factory.h"
#include "tools/evaluate/search_deciders.h"

namespace prospect::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kScene = 1'400'000;  // a tuning scene

class SceneVideo : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  const std::string folder_ = fs::temp_directory_path() / "prospect_scene_video";
  const std::unique_ptr<sim::Task> task_ = sim::MakeTask("navigation");
};

TEST_F(SceneVideo, IsWholeAndNamedByItsSceneAndEnding) {
  const auto random = MakeRandom();
  const EpisodeRecord episode = RunEpisode(*task_, *random, kScene, 0.01);
  const std::string path = WriteSceneVideo(*task_, kScene, episode, folder_);
  EXPECT_EQ(fs::path(path).filename(),
            std::to_string(kScene) + "-" + ToString(episode.ending) + ".mp4");
  EXPECT_TRUE(report::IsWholeMp4(path));
  const auto nothing = MakeNothing();
  const EpisodeRecord refused = RunEpisode(*task_, *nothing, kScene, 0.01);
  const std::string still = WriteSceneVideo(*task_, kScene, refused, folder_);
  EXPECT_TRUE(report::IsWholeMp4(still));
  EXPECT_LT(fs::file_size(still), fs::file_size(path)) << "it shows the ticks of the actions, too";
}

TEST_F(SceneVideo, OfAnotherEpisodeIsRefused) {
  const auto random = MakeRandom();
  EpisodeRecord episode = RunEpisode(*task_, *random, kScene, 0.01);
  episode.actions.clear();
  EXPECT_THROW(WriteSceneVideo(*task_, kScene, episode, folder_), std::logic_error);
}

}  // namespace
}  // namespace prospect::tools
