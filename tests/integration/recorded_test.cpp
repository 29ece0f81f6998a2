// A trial recorded from the bus by lcm-logger and imported equals the trial that `prospect collect`
// makes for that scene: frames as a reader sees them, and labels.

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "base/sensor_noise.h"
#include "model/dataset.h"
#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

constexpr int kSeed = 4321;

model::Trial ReadOnly(const std::string& path) {
  const model::TrialFile file(path);
  EXPECT_EQ(file.size(), 1u);
  return file.Read(0);
}

// The frames as training reads them: with the sensor noise that the file names.
std::vector<std::uint8_t> AsRead(model::Trial trial) {
  if (trial.image_noise <= 0) return trial.images;
  const auto bytes =
      static_cast<std::size_t>(trial.width) * static_cast<std::size_t>(trial.height) * 3;
  for (std::size_t frame = 0; frame < trial.actions.size(); ++frame) {
    base::AddSensorNoise(trial.images.data() + frame * bytes, bytes, trial.seed,
                         static_cast<std::int64_t>(frame), trial.image_noise);
  }
  return trial.images;
}

struct World {
  std::vector<std::string> simulator, executive, collector;  // arguments
};

void TrialEqualsTheCollectedOne(const std::string& name, const World& world) {
  Witness witness;
  Deployment deployment("recorded_" + name);
  const std::string log = deployment.folder + "/episode.lcmlog";
  const std::string seed = std::to_string(kSeed);
  Process logger("/usr/bin/lcm-logger", {"-q", log}, deployment.folder + "/logger.log");
  deployment.Simulator(world.simulator);
  std::vector<std::string> arguments{"--policy", "collect", "--services-timeout-ms", "20000"};
  arguments.insert(arguments.end(), world.executive.begin(), world.executive.end());
  auto& executive = deployment.Executive(arguments, kSeed);
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000));
  ASSERT_TRUE(code == 0 || code == 4) << code;
  witness.Listen(700);
  logger.Signal(2);
  ASSERT_GE(logger.Wait(5000), 0);

  Process importer("prospect-data", {"from-log", log, "--out", deployment.folder + "/recorded.h5"},
                   deployment.folder + "/import.log");
  ASSERT_EQ(importer.Wait(30000), 0) << ReadText(deployment.folder + "/import.log");
  arguments = {"collect", "--trials", "1",
               "--jobs",  "1",        "--seed",
               seed,      "--out",    deployment.folder + "/collected.h5"};
  arguments.insert(arguments.end(), world.collector.begin(), world.collector.end());
  Process collector("prospect-data", arguments, deployment.folder + "/collect.log");
  ASSERT_EQ(collector.Wait(30000), 0) << ReadText(deployment.folder + "/collect.log");

  const model::Trial recorded = ReadOnly(deployment.folder + "/recorded.h5");
  const model::Trial collected = ReadOnly(deployment.folder + "/collected.h5");
  EXPECT_EQ(recorded.seed, collected.seed);
  EXPECT_EQ(recorded.outcome, collected.outcome);
  EXPECT_EQ(recorded.reason, collected.reason);
  EXPECT_EQ(recorded.actions, collected.actions);
  EXPECT_EQ(recorded.prev_action, collected.prev_action);
  EXPECT_EQ(recorded.segment, collected.segment);
  EXPECT_EQ(recorded.segment_succeeded, collected.segment_succeeded);
  EXPECT_EQ(recorded.dones, collected.dones);
  EXPECT_EQ(recorded.present, collected.present);
  EXPECT_TRUE(AsRead(recorded) == AsRead(collected)) << "frames differ";
}

TEST(Recorded, TrialEqualsTheCollectedOne) {
  TrialEqualsTheCollectedOne("navigation",
                             {{}, {}, {"--task", "navigation", "--objects", "7", "--legs", "3"}});
}

TEST(Recorded, StackingTrialEqualsTheCollectedOne) {
  TrialEqualsTheCollectedOne("stacking",
                             {{"--task", "stacking"}, {"--tower", "2"}, {"--task", "stacking"}});
}

}  // namespace
}  // namespace prospect::tests
