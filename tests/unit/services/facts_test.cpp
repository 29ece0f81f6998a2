// What an episode may ask of a deployment that is up.

#include "services/supervisor/facts.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace prospect::services {
namespace {

DeploymentFacts Up() {
  DeploymentFacts up;
  up.bus = "udpm://x";
  up.task = "stacking";
  up.weights = "scripted";
  up.world = "simulator";
  up.workers = 2;
  return up;
}

bool Names(const std::string& text, const std::string& first, const std::string& second) {
  return text.find(first) != std::string::npos && text.find(second) != std::string::npos;
}

TEST(Wishes, ThatAreMetAreNoContradiction) {
  EXPECT_EQ(Contradiction(Up(), {}), "");
  Wish wish;
  wish.task = "stacking";
  wish.weights = "scripted";
  wish.workers = 2;
  wish.scene = true;
  EXPECT_EQ(Contradiction(Up(), wish), "");
}

TEST(Wishes, ThatContradictNameBoth) {
  Wish task;
  task.task = "navigation";
  EXPECT_TRUE(Names(Contradiction(Up(), task), "navigation", "stacking"));
  Wish weights;
  weights.weights = "mine.safetensors";
  EXPECT_TRUE(Names(Contradiction(Up(), weights), "mine.safetensors", "scripted"));
  Wish workers;
  workers.workers = 3;
  EXPECT_TRUE(Names(Contradiction(Up(), workers), "3", "2 are up"));
  Wish scene;
  scene.scene = true;
  DeploymentFacts robot = Up();
  robot.world = "robot";
  EXPECT_TRUE(Names(Contradiction(robot, scene), "--tower", "robot"));
}

TEST(Wishes, WeightsAreTheSameFileHoweverItIsNamed) {
  std::string name = testing::TempDir() + "facts_XXXXXX";
  const std::string folder = mkdtemp(name.data());
  // Of an old encoding: services.json cannot hold the byte.
  const std::string strange = folder + "/caf\xe9.safetensors";
  std::ofstream(folder + "/stacking.safetensors") << "x";
  std::ofstream(strange) << "x";
  DeploymentFacts up = Up();
  up.weights = WholePath(folder + "/stacking.safetensors");
  Wish wish;
  wish.weights = folder + "/../" + std::filesystem::path(folder).filename().string();
  EXPECT_EQ(Contradiction(up, wish), "") << "a folder stands for the task's file in it";
  up.weights = WholePath(folder) + "/caf\xef\xbf\xbd.safetensors";
  wish.weights = strange;
  EXPECT_EQ(Contradiction(up, wish), "");
  std::filesystem::remove_all(folder);
}

TEST(Facts, OfNoFileOrHalfAFileAreNone) {
  const std::string path = testing::TempDir() + "half.json";
  EXPECT_FALSE(ReadFacts("/no/such/services.json").has_value());
  std::ofstream(path) << "{\"deployment\": 1, \"bu";
  EXPECT_FALSE(ReadFacts(path).has_value());
  EXPECT_TRUE(ReadGivenUp(path).empty());
  std::ofstream(path) << "{\"deployment\": \"one\", \"services\": 3}";
  EXPECT_FALSE(ReadFacts(path).has_value());
  EXPECT_TRUE(ReadGivenUp(path).empty());
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace prospect::services
