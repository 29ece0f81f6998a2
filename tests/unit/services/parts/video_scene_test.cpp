// A video as the bus sees it.
#include "services/player/video_scene.h"

#include <gtest/gtest.h>

#include <fstream>

#include "lcmtypes/validate.h"
#include "model/dataset.h"
#include "report/video_writer.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::services {
namespace {

sim::Image Reddish(int red) {
  sim::Image image{64, 48, {}};
  for (int i = 0; i < 64 * 48; ++i)
    image.rgb.insert(image.rgb.end(), {static_cast<std::uint8_t>(red), 0, 0});
  return image;
}

class VideoSceneTest : public ::testing::Test {
 protected:
  VideoSceneTest() {
    choice_.video = folder_ / "film.avi";
    report::VideoWriter film(choice_.video, 25, 64, 48, report::VideoFormat::kMotionJpeg);
    for (int i = 1; i <= 20; ++i) film.Add(Reddish(10 * i));
    film.Finish();
  }
  void Transcribe(const std::string& text) {
    choice_.transcription = folder_ / "film.txt";
    std::ofstream(choice_.transcription) << text;
  }
  static int Red(const VideoScene& scene) { return scene.observation().data[0]; }

  model::TestFolder folder_;
  VideoChoice choice_;
};

TEST_F(VideoSceneTest, ShowsEveryNthFrameAndEachBeginning) {
  Transcribe("5 9 G1\n12 16 G11\n");
  choice_.every = 4;
  VideoScene scene(choice_);
  std::vector<int> shown, actions, segments, ends;
  while (scene.Next()) {
    shown.push_back(static_cast<int>(scene.observation().sim_time_us / 40000) + 1);
    EXPECT_NEAR(Red(scene), 10 * shown.back(), 8);
    EXPECT_EQ(scene.observation().frame, static_cast<std::int64_t>(shown.size()) - 1);
    EXPECT_EQ(scene.label()->frame, scene.observation().frame);
    EXPECT_EQ(messages::Validate(scene.observation()), "");
    EXPECT_EQ(messages::Validate(*scene.label()), "");
    actions.push_back(scene.label()->action);
    segments.push_back(scene.label()->segment);
    ends.push_back(scene.label()->segment_end);
  }
  EXPECT_EQ(shown, (std::vector<int>{1, 5, 9, 12, 13, 17}));
  EXPECT_EQ(actions, (std::vector<int>{15, 0, 0, 10, 10, 10}));
  EXPECT_EQ(segments, (std::vector<int>{-1, 0, 0, 1, 1, 1}));
  EXPECT_EQ(ends, (std::vector<int>{0, 0, 1, 0, 0, 0}));
  EXPECT_EQ(Red(scene), Red(scene)) << "the last picture stays";
}

TEST_F(VideoSceneTest, BeginsAgainAsAnotherEpisode) {
  VideoScene scene(choice_);
  ASSERT_TRUE(scene.Next());
  ASSERT_TRUE(scene.Next());
  scene.Restart(7);
  ASSERT_TRUE(scene.Next());
  EXPECT_EQ(scene.observation().episode_id, 7);
  EXPECT_EQ(scene.observation().frame, 0);
  EXPECT_NEAR(Red(scene), 10, 8);
  EXPECT_FALSE(scene.label().has_value()) << "nobody knows the gestures";
}

TEST_F(VideoSceneTest, TheTaskIsThatOfTheGestures) {
  const VideoScene scene(choice_);
  const task_t& task = scene.task();
  EXPECT_EQ(messages::Validate(task), "");
  EXPECT_EQ(task.name, "suturing");
  EXPECT_EQ(task.num_actions, 15);
  EXPECT_EQ(task.image_width, 128);
  EXPECT_EQ(task.image_height, 96);
  EXPECT_NEAR(task.tick_seconds, 3.0 / 25, 1e-9);
  EXPECT_NE(task.task_hash, 0);
  EXPECT_NE(GestureTask("knot_tying", task.tick_seconds).task_hash, task.task_hash);
}

TEST_F(VideoSceneTest, FaultyFilesAreNamed) {
  Transcribe("5 9 G99\n");
  EXPECT_THROW(VideoScene{choice_}, model::DataError);
  choice_.transcription.clear();
  choice_.video = folder_ / "none.avi";
  EXPECT_THROW(VideoScene{choice_}, model::DataError);
}

}  // namespace
}  // namespace prospect::services
