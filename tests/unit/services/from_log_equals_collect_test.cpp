// What is recorded from the bus trains like what is collected: the messages of the real simulator,
// logged and imported, give the trial that the collector makes for the same seed, with the frames
// as its reader would show them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "base/sensor_noise.h"
#include "services/from_log/log_importer.h"
#include "services/simulator/scene.h"
#include "sim/task_factory.h"
#include "tests/unit/services/log_writer.h"
#include "tools/collect/trial_recorder.h"

namespace prospect::services {
namespace {

constexpr double kNoise = 0.01;

// The actions of a trial, one a segment.
std::vector<int> PlanOf(const model::Trial& trial) {
  std::vector<int> plan;
  for (int i = 0; i < trial.frames(); ++i) {
    if (trial.segment[i] == static_cast<int>(plan.size())) plan.push_back(trial.actions[i]);
  }
  return plan;
}

// Publishes as the simulator does: each frame at least once, the ones it holds still on several
// times.
void RecordFromBus(std::uint64_t seed, const sim::TaskOptions& options,
                   const std::vector<int>& plan, const std::string& path) {
  LogWriter log(path);
  Scene scene("navigation", options, 4711, seed);
  const auto publish = [&] {
    log.Write(scene.observation());
    log.Write(scene.label());
  };
  publish();
  log.Write(scene.task());
  for (const int action : plan) {
    publish();
    ASSERT_EQ(scene.Start(action), "");
    while (scene.moving()) {
      scene.Tick();
      publish();
    }
  }
  publish();
}

model::Trial Import(const std::string& path) {
  std::vector<model::Trial> trials;
  LogImporter importer([&](const model::Trial& trial) { trials.push_back(trial); });
  EventLog log(path);
  LogEvent event;
  while (log.Next(event)) importer.Take(event);
  importer.EndOfLog();
  EXPECT_EQ(trials.size(), 1u) << (importer.rows().empty() ? "no run" : importer.rows()[0].reason);
  return trials.empty() ? model::Trial() : trials[0];
}

// Frames as a reader of data sets shows them: the sensor's noise over the clean ones.
std::vector<std::uint8_t> AsRead(const model::Trial& trial) {
  std::vector<std::uint8_t> images = trial.images;
  for (int i = 0; i < trial.frames(); ++i) {
    base::AddSensorNoise(images.data() + static_cast<std::size_t>(i) * trial.frame_bytes(),
                         trial.frame_bytes(), trial.seed, i, trial.image_noise);
  }
  return images;
}

void ExpectSameTrial(const model::Trial& recorded, const model::Trial& collected) {
  EXPECT_EQ(recorded.image_noise, 0);
  EXPECT_EQ(AsRead(recorded), AsRead(collected));
  EXPECT_EQ(recorded.actions, collected.actions);
  EXPECT_EQ(recorded.prev_action, collected.prev_action);
  EXPECT_EQ(recorded.segment, collected.segment);
  EXPECT_EQ(recorded.rewards, collected.rewards);
  EXPECT_EQ(recorded.dones, collected.dones);
  EXPECT_EQ(recorded.segment_succeeded, collected.segment_succeeded);
  EXPECT_EQ(recorded.outcome, collected.outcome);
  EXPECT_EQ(recorded.reason, collected.reason);
  EXPECT_EQ(recorded.present, collected.present);
  EXPECT_EQ(recorded.successors, collected.successors);
  EXPECT_EQ(recorded.light, collected.light);
  EXPECT_EQ(recorded.plan_length, collected.plan_length);
  EXPECT_EQ(recorded.world_version, collected.world_version);
  EXPECT_EQ(recorded.task_hash, collected.task_hash);
}

TEST(FromLogEqualsCollect, FrameByFrameAndLabelByLabel) {
  const std::string path = testing::TempDir() + "/equals_" + std::to_string(getpid()) + ".lcmlog";
  sim::TaskOptions options;
  options.image_noise = kNoise;
  const auto task = sim::MakeTask("navigation", options);
  bool failures = false;
  bool successes = false;
  for (std::uint64_t seed = 103; seed < 109; ++seed) {
    SCOPED_TRACE(seed);
    const model::Trial collected = tools::RecordRandomTrial(*task, seed, kNoise);
    RecordFromBus(seed, options, PlanOf(collected), path);
    ExpectSameTrial(Import(path), collected);
    (collected.succeeded() ? successes : failures) = true;
  }
  EXPECT_TRUE(failures && successes) << "choose seeds of both outcomes";
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace prospect::services
