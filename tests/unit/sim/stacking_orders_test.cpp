// In which order blocks may be stacked (planner/tower.h), against the world itself.

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "planner/tower.h"
#include "sim/oracle.h"
#include "sim/oracle_cache.h"
#include "sim/plan_rules.h"
#include "sim/random_plan.h"
#include "sim/rollout.h"
#include "sim/stacking/action_table.h"
#include "sim/stacking/stacking_task.h"
#include "sim/tabletop/scene_file.h"

namespace prospect::sim {
namespace {

constexpr int kBlocks = 4;

TaskOptions Tower(int levels) {
  TaskOptions options;
  options.tower = levels;
  return options;
}

planner::TaskRules Prepared(const TaskSpec& spec) {
  planner::TaskRules rules = PlanRules(spec);
  rules.Prepare();
  return rules;
}

// The actions that put one block onto another.
std::vector<int> Round(int upper, int lower) {
  std::vector<int> plan;
  for (int kind = 0; kind < kStackingKinds; ++kind) {
    const bool picks = kind < static_cast<int>(StackingKind::kAlignOver);
    plan.push_back(StackingIndex(static_cast<StackingKind>(kind), picks ? upper : lower, kBlocks));
  }
  return plan;
}

// Red on blue, then each of the twelve that may follow: those that the rules leave out build
// nothing, and of the others some do.
TEST(StackingOrders, WhatIsRuledOutBuildsNoTower) {
  StackingTask task(Tower(3));
  const planner::TaskRules rules = Prepared(task.spec());
  task.Reset(1600002);
  ASSERT_EQ(RunPlan(task, Round(0, 1), nullptr).outcome, Outcome::kRunning);
  ASSERT_EQ(task.Facts(), (std::vector<std::string>{"on(red,blue)"}));
  const auto here = task.Save();
  int ruled_out = 0, built = 0;
  for (int upper = 0; upper < kBlocks; ++upper) {
    for (int lower = 0; lower < kBlocks; ++lower) {
      if (upper == lower) continue;
      std::vector<int> plan = Round(0, 1);
      const std::vector<int> second = Round(upper, lower);
      plan.insert(plan.end(), second.begin(), second.end());
      task.Restore(*here);
      const bool success = RunPlan(task, second, nullptr).outcome == Outcome::kSuccess;
      const bool allowed = rules.Legal({}, {plan.begin(), plan.end()});
      EXPECT_TRUE(allowed || !success) << "block " << upper << " on " << lower;
      ruled_out += !allowed;
      built += success;
    }
  }
  EXPECT_EQ(ruled_out, 4) << "the same two again, either way, and the two others";
  EXPECT_GT(built, 0);
}

// What a random trial chooses, by the table alone: as if all went well.
std::vector<int> RandomTrial(const planner::TaskRules& rules, std::uint64_t seed, bool retries) {
  RandomPlan random(rules, seed, retries);
  std::vector<int> plan;
  const auto over = [&] {
    return static_cast<int>(plan.size()) >= rules.plan_length &&
           StackingActionAt(plan.back(), kBlocks).kind == StackingKind::kHome;
  };
  while (!over()) {
    const int last = plan.empty() ? rules.num_actions : plan.back();
    std::vector<int> legal = rules.successors.at(static_cast<std::size_t>(last));
    std::sort(legal.begin(), legal.end());
    plan.push_back(random.Choose(legal));
  }
  return plan;
}

TEST(StackingOrders, RandomTrialsCanBuildTheirTower) {
  const planner::TaskRules rules = Prepared(StackingTask(Tower(3)).spec());
  std::set<std::vector<int>> plans;
  int longer = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const std::vector<int> plan = RandomTrial(rules, seed, false);
    EXPECT_TRUE(rules.Legal({}, {plan.begin(), plan.end()})) << seed;
    plans.insert(plan);
    longer += RandomTrial(rules, seed, true).size() > 18;
  }
  EXPECT_GT(plans.size(), 80u);
  EXPECT_LE(plans.size(), 96u) << "all that can build it";
  EXPECT_GT(longer, 40);
}

// A trial that retries: the part that is begun anew counts no more.
TEST(StackingOrders, ARandomTrialThatBeginsAnewMayPutTheSameBlockAgain) {
  const planner::TaskRules rules = Prepared(StackingTask(Tower(3)).spec());
  int same = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    RandomPlan random(rules, seed, false);
    std::vector<int> round = Round(0, 1);
    round.resize(7);  // up to open(blue)
    for (const int action : round) random.Follow(action);
    random.Follow(0);
    for (int k = 1; k < 4; ++k) random.Follow(round[static_cast<std::size_t>(k)]);
    same += random.Choose({17, 18, 19}) == 17;
  }
  EXPECT_GT(same, 5) << "red on blue is still to be had";
}

// One second a trial: every plan fails at its first action, so that counting plans costs little.
TEST(StackingOrders, TheOracleTriesOnlyWhatCanBuildTheTower) {
  YAML::Node root = YAML::Load(DefaultStackingScene());
  root["stacking"]["time_limit"] = 1;
  TaskOptions options;
  options.scene_file = testing::TempDir() + "hasty_stacking.yaml";
  std::ofstream(options.scene_file) << YAML::Dump(root);
  const std::pair<int, std::size_t> cases[] = {{2, 12}, {3, 96}, {4, 768}};
  for (const auto& [levels, plans] : cases) {
    options.tower = levels;
    StackingTask task(options);
    task.Reset(1600000);
    EXPECT_EQ(ConsultOracle(task, 1600000, {1, 1}).plans.size(), plans);
    EXPECT_EQ(OracleKeyOf(task, 4).ordered, levels > 2) << "two are kept under their old name";
    EXPECT_EQ(planner::TowerLevels(Prepared(task.spec())), levels);
  }
}

}  // namespace
}  // namespace prospect::sim
