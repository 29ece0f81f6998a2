#include "services/simulator/scene.h"

#include <gtest/gtest.h>

#include "base/sensor_noise.h"
#include "lcmtypes/validate.h"
#include "services/binding/task_messages.h"
#include "sim/rollout.h"

namespace prospect::services {
namespace {

constexpr std::uint64_t kSeed = 12;
constexpr std::int64_t kEpisode = 77;

struct NoisyFrames : sim::FrameSink {
  void OnFrame(const sim::Image& image, const sim::Progress& now) override {
    frames.push_back(image.rgb);
    base::AddSensorNoise(frames.back().data(), frames.back().size(), kSeed,
                         static_cast<std::int64_t>(frames.size()) - 1, 0.01);
    progress.push_back(now);
  }
  std::vector<std::vector<std::uint8_t>> frames;
  std::vector<sim::Progress> progress;
};

// What goes over the bus is what a collector of trials sees for the same scene and plan.
TEST(SceneTest, FramesEqualTheRolloutsWithSensorNoise) {
  auto task = sim::MakeTask("navigation");
  task->Reset(kSeed);
  const int action = task->LegalActions().front();
  NoisyFrames expected;
  sim::RunPlan(*task, {action}, &expected);

  Scene scene("navigation", {}, kEpisode, kSeed);
  ASSERT_EQ(scene.observation().data, expected.frames[0]);
  ASSERT_EQ(scene.Start(action), "");
  for (std::size_t frame = 1; frame < expected.frames.size(); ++frame) {
    ASSERT_TRUE(scene.moving());
    scene.Tick();
    ASSERT_EQ(scene.frame(), static_cast<std::int64_t>(frame));
    EXPECT_TRUE(scene.observation().data == expected.frames[frame]) << frame;
    EXPECT_EQ(scene.label().action, expected.progress[frame].action);
    EXPECT_EQ(scene.label().segment_end, frame + 1 == expected.frames.size() ? 1 : 0);
  }
  EXPECT_FALSE(scene.moving());
}

TEST(SceneTest, RefusesWhatCannotBeDone) {
  Scene scene("navigation", {}, kEpisode, kSeed);
  EXPECT_NE(scene.Start(200), "");
  EXPECT_NE(scene.Start(-1), "");
  const auto& present = scene.label().present;
  int action = 0;
  while (!present.at(static_cast<std::size_t>(action))) ++action;
  ASSERT_EQ(scene.Start(action), "");
  EXPECT_NE(scene.Start(action), "") << "one action at a time";
}

TEST(SceneTest, CancelBrakesAndThenHoldsStill) {
  Scene scene("navigation", {}, kEpisode, kSeed);
  int action = 0;
  while (!scene.Start(action).empty()) ++action;
  scene.Tick();
  ASSERT_TRUE(scene.running()) << "this scene's first action should take a while";
  scene.Cancel();
  EXPECT_FALSE(scene.running());
  int ticks = 0;
  while (scene.moving() && ticks < 100) scene.Tick(), ++ticks;
  EXPECT_GT(ticks, 0);
  EXPECT_LT(ticks, 100);
  EXPECT_EQ(scene.label().outcome, label_t::OUTCOME_RUNNING);
}

TEST(SceneTest, OptionsOutOfRangeLeaveTheSceneAlone) {
  Scene scene("navigation", {}, kEpisode, kSeed);
  const auto hash = scene.task().task_hash;
  EXPECT_THROW(scene.Reset(kEpisode + 1, 13, 99, 3), std::invalid_argument);
  EXPECT_EQ(scene.episode_id(), kEpisode);
  scene.Reset(kEpisode + 1, 13, 7, 5);
  EXPECT_EQ(scene.episode_id(), kEpisode + 1);
  EXPECT_EQ(scene.task().plan_length, 5);
  EXPECT_NE(scene.task().task_hash, hash);
  EXPECT_EQ(TaskHash(scene.task()), scene.task().task_hash);
}

// The same seed is the same scene, and yet another episode.
TEST(SceneTest, AResetBeginsAnotherEpisodeWhateverItsSeed) {
  Scene scene("navigation", {}, kEpisode, kSeed);
  const auto first = scene.observation();
  EXPECT_EQ(first.episode_id, kEpisode);
  EXPECT_EQ(scene.label().seed, static_cast<std::int64_t>(kSeed));
  EXPECT_THROW(scene.Reset(kEpisode, kSeed, 0, 0), std::invalid_argument);
  scene.Reset(kEpisode + 1, kSeed, 0, 0);
  EXPECT_EQ(scene.observation().episode_id, kEpisode + 1);
  EXPECT_EQ(scene.observation().data, first.data);
  EXPECT_EQ(scene.label().episode_id, kEpisode + 1);
  EXPECT_EQ(scene.label().seed, static_cast<std::int64_t>(kSeed));
}

// Stacking needs no message of its own: plan length is what tells its towers apart.
TEST(SceneTest, StackingSpeaksTheSameMessages) {
  Scene scene("stacking", {}, kEpisode, kSeed);
  EXPECT_EQ(scene.task().num_actions, 36);
  EXPECT_EQ(scene.task().plan_length, 9);
  EXPECT_EQ(scene.task().repeats_allowed, 1);
  EXPECT_EQ(scene.observation().width, 64);
  for (const int action : {-1, 4, 35, 36}) EXPECT_NE(scene.Start(action), "") << action;
  EXPECT_EQ(scene.frame(), 0);
  ASSERT_EQ(scene.Start(2), "");
  scene.Tick();
  EXPECT_EQ(scene.label().action, 2);
  scene.Reset(kEpisode + 1, kSeed, 0, 18);
  EXPECT_EQ(scene.task().plan_length, 18);
  EXPECT_THROW(scene.Reset(kEpisode + 2, kSeed, 0, 10), std::invalid_argument);
  EXPECT_EQ(scene.task().plan_length, 18) << "a refused reset leaves the scene as it was";
  ASSERT_EQ(scene.Start(2), "");
}

// Gestures are numbered as in JIGSAWS, less one; those that suturing does not have are never legal.
TEST(SceneTest, SuturingSpeaksTheSameMessages) {
  Scene scene("suturing", {}, kEpisode, kSeed);
  EXPECT_EQ(messages::Validate(scene.task()), "");
  EXPECT_EQ(messages::Validate(scene.observation()), "");
  EXPECT_EQ(messages::Validate(scene.label()), "");
  EXPECT_EQ(scene.task().num_actions, 15);
  EXPECT_EQ(scene.observation().width, 128);
  EXPECT_EQ(scene.observation().height, 96);
  EXPECT_EQ(scene.label().present[0], 1);
  EXPECT_EQ(scene.label().present[6], 0);
  for (const int action : {1, 6, 14, 15}) EXPECT_NE(scene.Start(action), "") << action;
  ASSERT_EQ(scene.Start(0), "");
  while (scene.running()) scene.Tick();
  EXPECT_EQ(scene.label().segment_end, 1);
  EXPECT_EQ(scene.label().action, 0);
  EXPECT_EQ(messages::Validate(scene.label()), "");
  ASSERT_EQ(scene.Start(4), "");
}

}  // namespace
}  // namespace prospect::services
