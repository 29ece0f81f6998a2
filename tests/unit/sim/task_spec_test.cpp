#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "sim/rollout.h"
#include "sim/task_factory.h"

namespace prospect::sim {
namespace {

TEST(TaskSpec, NavigationTableIsFrozen) {
  const TaskSpec spec = MakeTask("navigation")->spec();
  const char* objects[] = {"barrel", "barricade", "pylon", "block", "spool", "generator", "cabin"};
  ASSERT_EQ(spec.actions.size(), 7u);
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(spec.actions[i].index, i);
    EXPECT_EQ(spec.actions[i].kind, "investigate");
    EXPECT_EQ(spec.actions[i].object, objects[i]);
    EXPECT_EQ(spec.actions[i].name, "investigate(" + std::string(objects[i]) + ")");
  }
  EXPECT_EQ(spec.null_action(), 7);
  EXPECT_EQ(spec.successors[7], (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(spec.successors[2], (std::vector<int>{0, 1, 3, 4, 5, 6}));
  EXPECT_FALSE(spec.repeats_allowed);
}

TEST(TaskSpec, HashSeesTheTableAndNotTheScene) {
  TaskSpec spec = MakeTask("navigation", {4, 3})->spec();
  EXPECT_EQ(spec.Hash(), MakeTask("navigation", {7, 5})->spec().Hash());
  const std::uint64_t hash = spec.Hash();
  spec.actions[1].object = "fence";
  EXPECT_NE(spec.Hash(), hash);
}

TEST(TaskSpec, HashChangesWithEachPart) {
  const TaskSpec spec = MakeTask("navigation")->spec();
  TaskSpec other = spec;
  other.repeats_allowed = true;
  EXPECT_NE(other.Hash(), spec.Hash());
  other = spec;
  other.image_width = 96;
  EXPECT_NE(other.Hash(), spec.Hash());
  other = spec;
  other.successors[0].pop_back();
  EXPECT_NE(other.Hash(), spec.Hash());
}

TEST(TaskSpec, EveryCauseHasANameOfItsOwnAndWords) {
  for (const std::string& name : TaskNames()) {
    std::set<std::string> names;
    const auto task = MakeTask(name);
    for (const CauseSpec& cause : task->spec().causes) {
      EXPECT_TRUE(names.insert(cause.name).second) << name << ": " << cause.name;
      EXPECT_FALSE(cause.words.empty()) << name << ": " << cause.name;
    }
    EXPECT_EQ(names.count("time"), 1u) << name;
  }
}

TEST(TaskSpec, WhatTrialsFailOfIsAmongTheCauses) {
  const auto task = MakeTask("navigation");
  std::set<std::string> causes, seen;
  for (const CauseSpec& cause : task->spec().causes) causes.insert(cause.name);
  for (std::uint64_t seed = 1'400'000; seed < 1'400'012; ++seed) {
    task->Reset(seed);
    const std::vector<int> legal = task->LegalActions();
    const RolloutResult result = RunPlan(*task, {legal.at(0), legal.at(1), legal.at(2)}, nullptr);
    if (result.outcome == Outcome::kFailure) seen.insert(result.reason);
  }
  EXPECT_FALSE(seen.empty());
  for (const std::string& reason : seen) EXPECT_EQ(causes.count(reason), 1u) << reason;
}

TEST(TaskFactory, NamesTheTasksItKnows) {
  try {
    MakeTask("cooking");
    FAIL() << "made an unknown task";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("navigation"), std::string::npos);
  }
}

TEST(TaskFactory, RefusesScenesOutOfRange) {
  EXPECT_THROW(MakeTask("navigation", {3, 3}), std::invalid_argument);
  EXPECT_THROW(MakeTask("navigation", {8, 3}), std::invalid_argument);
  EXPECT_THROW(MakeTask("navigation", {7, 2}), std::invalid_argument);
  EXPECT_THROW(MakeTask("navigation", {7, 6}), std::invalid_argument);
  EXPECT_THROW(MakeTask("navigation", {4, 5}), std::invalid_argument);
}

}  // namespace
}  // namespace prospect::sim
