#include "planner/baseline_plans.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "planner/scripted_model.h"
#include "planner/search.h"
#include "tests/unit/planner/table_model.h"

namespace prospect::planner {
namespace {

ScriptedModel Scripted(std::uint64_t seed, int num_actions = 5) {
  ScriptedModelParameters parameters;
  parameters.num_actions = num_actions;
  parameters.seed = seed;
  return ScriptedModel(parameters);
}

TEST(Exhaustive, EvaluatesEveryOrderOnce) {
  ScriptedModel model = Scripted(1);
  const ExhaustiveResult all = ExhaustivePlan(AnyOrder(5, 3), {}, {}, &model, false);
  EXPECT_EQ(all.evaluations, 1 + 5 + 20 + 60);
  EXPECT_EQ(model.evaluations(), all.evaluations);
}

TEST(Exhaustive, PruningChangesTheCostOnly) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    ScriptedModel model = Scripted(seed);
    const ExhaustiveResult all = ExhaustivePlan(AnyOrder(5, 3), {}, {}, &model, false, 7);
    const ExhaustiveResult pruned = ExhaustivePlan(AnyOrder(5, 3), {}, {}, &model, true, 64);
    EXPECT_EQ(all.plan.status, pruned.plan.status);
    EXPECT_EQ(all.plan.best.path, pruned.plan.best.path);
    EXPECT_EQ(all.plan.best.score, pruned.plan.best.score);
    EXPECT_LT(pruned.evaluations, all.evaluations);
  }
}

// A search that runs until everything is known reads off the same plan as the exhaustive expansion,
// by every rule that goes everywhere in the end (gumbel does not).
TEST(Exhaustive, IsWhatASearchConvergesTo) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    ScriptedModel model = Scripted(seed);
    const ExhaustiveResult all = ExhaustivePlan(AnyOrder(5, 3), {}, {}, &model);
    for (const char* rule : {"paper", "puct", "random"}) {
      SearchParameters parameters;
      parameters.rule = rule;
      parameters.samples = 100'000;
      parameters.c = parameters.c_puct = 1000;  // to every corner
      Search search(AnyOrder(5, 3), parameters, {}, {});
      RunSearch(&search, &model, 4);
      EXPECT_EQ(search.stop_reason(0), StopReason::kExhausted);
      EXPECT_EQ(search.evaluations(), all.evaluations);
      EXPECT_EQ(search.BestPlan().best.path, all.plan.best.path);
      EXPECT_EQ(search.BestPlan().status, all.plan.status);
    }
  }
}

TEST(Exhaustive, RespectsExecutedActionsAndDepth) {
  ScriptedModel model = Scripted(3);
  const ExhaustiveResult rest = ExhaustivePlan(AnyOrder(5, 3), {}, {4}, &model, false);
  EXPECT_EQ(rest.evaluations, 1 + 4 + 12);
  SearchParameters parameters;
  parameters.depth = 1;
  EXPECT_EQ(ExhaustivePlan(AnyOrder(5, 3), parameters, {4}, &model, false).evaluations, 5);
}

TEST(Greedy, TakesTheHighestPermittedQ) {
  TableModel model = TwoActionModel();
  EXPECT_EQ(GreedyPlan(AnyOrder(2, 2), {}, {}, &model), (Path{0, 1}));
  EXPECT_EQ(model.asked, (std::vector<Path>{{}, {0}}));
  model.At({}).p = {0.0f, 1.0f};
  EXPECT_EQ(GreedyPlan(AnyOrder(2, 2), {}, {}, &model), (Path{1, 0}));
  model.At({}).p = {0.0f, 0.0f};
  EXPECT_TRUE(GreedyPlan(AnyOrder(2, 2), {}, {}, &model).empty());
}

TEST(Greedy, TiesGoToTheLowerIndex) {
  TableModel model = TwoActionModel();
  model.At({}).q = {0.3f, 0.3f};
  EXPECT_EQ(GreedyPlan(AnyOrder(2, 2), {}, {}, &model).at(0), 0);
}

TEST(RandomPlan, IsLegalRepeatableAndCoversAll) {
  const TaskRules rules = AnyOrder(4, 3);
  std::set<Path> seen;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Path path = RandomPlan(rules, {2}, seed);
    EXPECT_EQ(path, RandomPlan(rules, {2}, seed));
    EXPECT_TRUE(rules.Legal({2}, path));
    EXPECT_TRUE(rules.Complete({2}, path));
    seen.insert(path);
  }
  EXPECT_EQ(seen.size(), 6u);
}

TEST(Baselines, RefuseUnsoundModels) {
  TableModel model = TwoActionModel();
  model.At({0}).value = 2;
  EXPECT_THROW(ExhaustivePlan(AnyOrder(2, 2), {}, {}, &model), std::runtime_error);
  Search search(AnyOrder(2, 2), {}, {}, {});
  EXPECT_THROW(RunSearch(&search, &model), std::runtime_error);
}

}  // namespace
}  // namespace prospect::planner
