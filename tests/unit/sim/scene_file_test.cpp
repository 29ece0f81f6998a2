#include "sim/tabletop/scene_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "sim/tabletop/tabletop_world.h"

namespace prospect::sim {
namespace {

// The default scene with one entry changed.
YamlReader With(const std::vector<std::string>& where, const std::string& value) {
  YAML::Node root = YAML::Load(DefaultStackingScene());
  YAML::Node at = root;
  for (std::size_t i = 0; i + 1 < where.size(); ++i) at.reset(at[where[i]]);
  at[where.back()] = YAML::Load(value);
  return YamlReader(root, "");
}

std::string WhyRefused(const YamlReader& root) {
  try {
    ReadTabletop(root);
  } catch (const SceneFileError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneFile, DefaultHoldsTheUr5) {
  const TabletopDescription scene = ReadTabletop(OpenSceneFile(""));
  EXPECT_EQ(scene.arm.name, "UR5");
  EXPECT_DOUBLE_EQ(scene.arm.lengths.a2, kUr5.a2);
  EXPECT_EQ(scene.blocks.size(), 4u);
  EXPECT_EQ(scene.blocks[2].name, "yellow");
  EXPECT_EQ(scene.cameras.count("view"), 1u);
  double mass = 0;
  for (const BodyDescription& link : scene.arm.links) mass += link.mass;
  EXPECT_NEAR(mass, 17.05, 0.01);
}

TEST(SceneFile, RefusesWithTheEntrysName) {
  EXPECT_NE(WhyRefused(With({"gripper", "force"}, "-3")).find("gripper.force"), std::string::npos);
  EXPECT_NE(WhyRefused(With({"gripper", "force"}, ".nan")).find("gripper.force"),
            std::string::npos);
  EXPECT_NE(WhyRefused(With({"gripper", "forse"}, "3")).find("gripper.forse"), std::string::npos);
  EXPECT_NE(WhyRefused(With({"physics", "step"}, "1.0")).find("physics.step"), std::string::npos);
  EXPECT_NE(WhyRefused(With({"arm", "dh", "a2"}, "far")).find("arm.dh.a2"), std::string::npos);
  EXPECT_NE(WhyRefused(With({"arm", "links"}, "[]")).find("arm.links"), std::string::npos);
  EXPECT_NE(WhyRefused(With({"arm", "torque_limit"}, "[1, 2]")).find("arm.torque_limit"),
            std::string::npos);
  EXPECT_NE(WhyRefused(With({"blocks"}, "[]")).find("blocks"), std::string::npos);
  EXPECT_NE(WhyRefused(With({"cameras"}, "{}")).find("cameras.robot"), std::string::npos);
  EXPECT_NE(WhyRefused(With({"obstacle", "mass"}, "0")).find("obstacle.mass"), std::string::npos);
  EXPECT_NE(WhyRefused(With({"obstacle", "both"}, "[{box: [0, 1, 1]}]")).find("box"),
            std::string::npos);
  EXPECT_THROW(OpenSceneFile("/nowhere/scene.yaml"), SceneFileError);
}

TEST(SceneFile, AnEntryThatComesTwiceIsRefusedByName) {
  const std::string path = testing::TempDir() + "scene_twice_" + std::to_string(getpid()) + ".yaml";
  std::string text = DefaultStackingScene();
  const std::size_t at = text.find("\n  force:");  // of the gripper
  ASSERT_NE(at, std::string::npos);
  text.insert(at, "\n  force: 3");
  std::ofstream(path) << text;
  std::string why;
  try {
    OpenSceneFile(path);
  } catch (const SceneFileError& error) {
    why = error.what();
  }
  std::filesystem::remove(path);
  EXPECT_NE(why.find("names 'gripper.force' twice"), std::string::npos) << why;
}

TEST(SceneFile, AnotherArmAndOtherThingsNeedNoCode) {
  YAML::Node root = YAML::Load(DefaultStackingScene());
  root["arm"]["name"] = "UR3";
  root["arm"]["dh"] =
      YAML::Load("{d1: 0.1519, a2: -0.24365, a3: -0.21325, d4: 0.11235, d5: 0.08535, d6: 0.0819}");
  root["blocks"].push_back(
      YAML::Load("{name: purple, mass: 0.05, friction: 1.0, both: [{sphere: 0.02, color: red}]}"));
  TabletopWorld world(ReadTabletop(YamlReader(root, "")));
  EXPECT_EQ(world.loose().size(), 6);
  world.arm().Place({0.3, -1.3, -1.8, -0.3, 1.5, 1.6}, 0.05);
  for (int i = 0; i < 6; ++i) {
    world.loose().Place(i, Eigen::Isometry3d(Eigen::Translation3d(-0.4, -0.3 + 0.12 * i, 0.1)));
  }
  for (int i = 0; i < 100; ++i) world.Step();
  EXPECT_NEAR(world.loose().body(4).frame().translation().z(), 0.02, 2e-3);
}

TEST(SceneFile, HashTellsContentsNotLayout) {
  const YamlReader root = OpenSceneFile("");
  EXPECT_EQ(SceneHash(root, 1), SceneHash(OpenSceneFile(""), 1));
  EXPECT_NE(SceneHash(root, 1), SceneHash(root, 2));
  EXPECT_NE(SceneHash(root, 1), SceneHash(With({"gripper", "force"}, "21"), 1));
}

}  // namespace
}  // namespace prospect::sim
