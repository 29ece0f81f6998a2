#include "tools/evaluate/crew_search.h"

#include <gtest/gtest.h>

#include "planner/scripted_tree.h"

namespace prospect::tools {
namespace {

planner::SearchParameters ParametersFor(int workers) {
  planner::SearchParameters parameters;
  parameters.samples = 400;
  parameters.depth = planner::ScriptedTree::kDepth;
  parameters.workers = workers;
  return parameters;
}

CrewResult SearchTree(int workers, std::uint64_t seed) {
  planner::ScriptedTreeModel model(seed);
  return SearchWithCrew(planner::ScriptedTree::Rules(), ParametersFor(workers), {}, &model);
}

TEST(CrewSearchTest, TheRolloutsAreOfAllWorkersTogether) {
  for (const int workers : {1, 4, 8}) {
    const CrewResult result = SearchTree(workers, 3);
    EXPECT_TRUE(result.plan.ok());
    EXPECT_GE(result.rollouts, 400 - workers);
    EXPECT_LE(result.rollouts, 400 + 3 * workers);
    EXPECT_GT(result.evaluations, 100);
  }
}

TEST(CrewSearchTest, IsRepeatable) {
  const CrewResult one = SearchTree(4, 5), two = SearchTree(4, 5);
  EXPECT_EQ(one.plan.best.path, two.plan.best.path);
  EXPECT_EQ(one.rollouts, two.rollouts);
  EXPECT_EQ(one.evaluations, two.evaluations);
}

TEST(CrewSearchTest, FourWorkersDecideNearlyAsWellAsOne) {
  double regret_of_one = 0, regret_of_four = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const double best = planner::ScriptedTree{seed}.FindOptimum().value;
    regret_of_one += best - SearchTree(1, seed).plan.best.score;
    regret_of_four += best - SearchTree(4, seed).plan.best.score;
  }
  EXPECT_LE(regret_of_four / 20, regret_of_one / 20 + 0.01);
}

}  // namespace
}  // namespace prospect::tools
