#include "tools/evaluate/report.h"

#include <gtest/gtest.h>

namespace prospect::tools {
namespace {

SceneRecord Scene(const std::string& scene_class, const std::string& planner,
                  const std::string& random, double oracle) {
  const auto row = [](const std::string& ending) {
    return nlohmann::json{{"ending", ending}, {"seconds", {0.1, 0.2}}, {"evaluations", 10}};
  };
  return {{"class", scene_class},
          {"oracle_success", oracle},
          {"solved_at_start", false},
          {"rows", {{"planner", row(planner)}, {"random", row(random)}}}};
}

TEST(Summarise, CountsEachEndingWithinItsClass) {
  const std::vector<SceneRecord> scenes = {
      Scene("solvable", "solved", "failed", 1.0),  Scene("solvable", "solved", "solved", 0.8),
      Scene("solvable", "refused", "failed", 1.0), Scene("solvable", "stopped", "failed", 0.8),
      Scene("hopeless", "refused", "failed", 0.0), Scene("doubtful", "failed", "failed", 0.4)};
  const nlohmann::json s = Summarise(scenes, {"planner", "random"});
  EXPECT_EQ(s["scenes"], 6);
  EXPECT_EQ(s["solvable"], 4);
  EXPECT_EQ(s["hopeless"], 1);
  EXPECT_EQ(s["doubtful"], 1);
  EXPECT_DOUBLE_EQ(s["solved_solvable"], 0.5);
  EXPECT_DOUBLE_EQ(s["refused_solvable"], 0.25);
  EXPECT_DOUBLE_EQ(s["stopped_solvable"], 0.25);
  EXPECT_DOUBLE_EQ(s["failed_solvable"], 0.0);
  EXPECT_DOUBLE_EQ(s["refused_hopeless"], 1.0);
  EXPECT_DOUBLE_EQ(s["random_solved_solvable"], 0.25);
  EXPECT_DOUBLE_EQ(s["oracle_success"], 0.9);
  EXPECT_NEAR(s["solved_over_oracle"].get<double>(), 0.5 / 0.9, 1e-12);
}

TEST(SummariseUnclassed, CountsAllScenesAndPairsRows) {
  const std::vector<SceneRecord> scenes = {
      Scene("", "solved", "failed", 0), Scene("", "solved", "solved", 0),
      Scene("", "refused", "failed", 0), Scene("", "failed", "failed", 0)};
  const nlohmann::json s = SummariseUnclassed(scenes, {"planner", "random"});
  EXPECT_EQ(s["scenes"], 4);
  EXPECT_DOUBLE_EQ(s["solved"], 0.5);
  EXPECT_EQ(s["refused_count"], 1);
  EXPECT_DOUBLE_EQ(s["random_solved"], 0.25);
  EXPECT_DOUBLE_EQ(s["planner_minus_random"], 0.25);
  EXPECT_LT(s["planner_minus_random_interval"][0].get<double>(), 0.25);
  EXPECT_FALSE(s.contains("oracle_success"));
}

TEST(Summarise, LeavesOutScenesSolvedAtTheStart) {
  std::vector<SceneRecord> scenes = {Scene("solvable", "solved", "solved", 1.0),
                                     Scene("solvable", "failed", "failed", 1.0)};
  scenes[0]["solved_at_start"] = true;
  const nlohmann::json s = Summarise(scenes, {"planner", "random"});
  EXPECT_EQ(s["scenes"], 1);
  EXPECT_EQ(s["solved_at_start_excluded"], 1);
  EXPECT_DOUBLE_EQ(s["solved_solvable"], 0.0);
}

// Two of four scenes differ, both the same way: mean 0.5, variance 0.25.
TEST(Summarise, ComparesRowsSceneByScene) {
  const std::vector<SceneRecord> scenes = {
      Scene("solvable", "solved", "failed", 1.0), Scene("solvable", "solved", "failed", 1.0),
      Scene("solvable", "solved", "solved", 1.0), Scene("solvable", "failed", "failed", 1.0),
      Scene("hopeless", "refused", "failed", 0.0)};
  const nlohmann::json s = Summarise(scenes, {"planner", "random"});
  EXPECT_DOUBLE_EQ(s["planner_minus_random"], 0.5);
  EXPECT_NEAR(s["planner_minus_random_interval"][0].get<double>(), 0.5 - 1.96 * 0.25, 1e-12);
}

TEST(Summarise, CountsLostPlansThatCouldStillBeFinished) {
  std::vector<SceneRecord> scenes(4, Scene("solvable", "solved", "failed", 1.0));
  scenes.push_back(Scene("doubtful", "failed", "failed", 0.4));
  for (const int i : {1, 2, 4})
    scenes[i]["rows"]["planner"]["lost"] = {{"anew", i == 2 ? "hopeless" : "solvable"}};
  const nlohmann::json s = Summarise(scenes, {"planner", "random"});
  EXPECT_EQ(s["lost"], 3);
  EXPECT_EQ(s["lost_recoverable"], 2);
  EXPECT_EQ(s["lost_finished_count"], 1);
  EXPECT_DOUBLE_EQ(s["lost_finished"], 0.5);
  EXPECT_NE(Table(s, {"planner"}).find("could still finish 2, the planner finished 1"),
            std::string::npos);
}

TEST(Table, SaysWhatTheSummarySays) {
  const nlohmann::json s =
      Summarise({Scene("solvable", "solved", "failed", 1.0)}, {"planner", "random"});
  const std::string table = Table(s, {"planner", "random"});
  EXPECT_NE(table.find("1 scenes: 1 solvable"), std::string::npos);
  EXPECT_NE(table.find("random, solvable: solved"), std::string::npos);
}

}  // namespace
}  // namespace prospect::tools
