#include "planner/plan_reader.h"

#include <gtest/gtest.h>

#include "planner/baseline_plans.h"
#include "planner/search.h"
#include "tests/unit/planner/table_model.h"

namespace prospect::planner {
namespace {

// Searches the two-action tree to its end and reads the plan off.
Plan PlanOf(TableModel model, SearchParameters parameters = {}, int plan_length = 2) {
  Search search(AnyOrder(2, plan_length), parameters, {}, {});
  RunSearch(&search, &model);
  return search.BestPlan();
}

// 0-1: V = 0.5, f = 0.9 0.5; 1-0: V = 0.9, f = 0.8 0.9.
TEST(PlanReader, BestScoreIsVTimesFAlongThePath) {
  const Plan plan = PlanOf(TwoActionModel());
  ASSERT_TRUE(plan.ok()) << plan.reason;
  EXPECT_EQ(plan.best.path, (Path{1, 0}));
  EXPECT_NEAR(plan.best.score, 0.9 * 0.8 * 0.9, 1e-6);
  EXPECT_TRUE(plan.best.complete);
  EXPECT_EQ(plan.best.visits, 1);
  EXPECT_NEAR(plan.root_value, 0.5, 1e-6);
  ASSERT_EQ(plan.best.steps.size(), 2u);
  const PlanStep& first = plan.best.steps[0];
  EXPECT_EQ(first.action, 1);
  EXPECT_NEAR(first.value, 0.6, 1e-6);
  EXPECT_NEAR(first.done, 0.8, 1e-6);
  EXPECT_NEAR(first.score, 0.48, 1e-6);
  EXPECT_NEAR(first.q, 0.2, 1e-4);
  EXPECT_NEAR(first.prior, 1, 1e-4);
  ASSERT_EQ(plan.runners_up.size(), 1u);
  EXPECT_EQ(plan.runners_up[0].path, (Path{0, 1}));
  EXPECT_NEAR(plan.runners_up[0].score, 0.5 * 0.9 * 0.5, 1e-6);
  EXPECT_EQ(plan.complete_futures, 2);
  EXPECT_EQ(plan.untried, 0);
}

TEST(PlanReader, TiesGoByVisitsThenByActionIndex) {
  TableModel model = TwoActionModel();
  model.At({1, 0}) = model.At({0, 1});
  model.At({1}).done = model.At({0}).done;
  SearchParameters parameters;
  EXPECT_EQ(PlanOf(model, parameters).best.path, (Path{0, 1}));  // N = 2 against 1
  // Without visits: the lower action index.
  const ExhaustiveResult all = ExhaustivePlan(AnyOrder(2, 2), parameters, {}, &model);
  EXPECT_EQ(all.plan.best.path, (Path{0, 1}));
  EXPECT_EQ(all.plan.runners_up.at(0).score, all.plan.best.score);
}

TEST(PlanReader, RefusesWhenEveryFutureFailsAndSaysWhy) {
  TableModel model = TwoActionModel();
  model.At({0}).done = 0.05f;
  model.At({1}).p = {0.001f, 1.0f};
  const Plan plan = PlanOf(model);
  EXPECT_EQ(plan.status, PlanStatus::kRefused);
  EXPECT_EQ(plan.not_done, 1);
  EXPECT_EQ(plan.not_permitted, 1);
  EXPECT_EQ(plan.low_value, 0);
  EXPECT_EQ(plan.reason,
            "every future fails: 1 not permitted (p < 0.010), 1 with an action that would not "
            "finish (f < 0.100)");
  ASSERT_EQ(plan.rejected.size(), 2u);
  EXPECT_EQ(plan.rejected[0].path, (Path{1, 0}));  // came furthest
  EXPECT_EQ(plan.rejected[0].rejection, Rejection::kNotPermitted);
  ASSERT_EQ(plan.rejected[0].steps.size(), 2u);
  EXPECT_NEAR(plan.rejected[0].steps[1].prior, 0.001, 1e-4);
  EXPECT_EQ(plan.rejected[1].path, Path{0});
  EXPECT_EQ(plan.rejected[1].rejection, Rejection::kNotDone);
  EXPECT_NEAR(plan.rejected[1].steps[0].done, 0.05, 1e-6);
}

TEST(PlanReader, NumbersThatAreComparedDiffer) {
  SearchParameters parameters;
  parameters.refusal_threshold = 0.64804;
  const Plan plan = PlanOf(TwoActionModel(), parameters);
  EXPECT_EQ(plan.reason,
            "the best of 2 complete futures scores 0.64800, below the threshold of 0.64804");
}

TEST(PlanReader, LowValueAtTheLastStepIsRejectedToo) {
  TableModel model = TwoActionModel();
  model.At({1, 0}).value = 0.01f;
  model.At({0, 1}).done = 0.09f;
  const Plan plan = PlanOf(model);
  EXPECT_EQ(plan.status, PlanStatus::kRefused);
  EXPECT_EQ(plan.low_value, 1);
  EXPECT_EQ(plan.not_done, 1);
  EXPECT_EQ(plan.complete_futures, 0);
}

TEST(PlanReader, RefusalThreshold) {
  SearchParameters parameters;
  parameters.refusal_threshold = 0.64;
  EXPECT_TRUE(PlanOf(TwoActionModel(), parameters).ok());
  EXPECT_TRUE(PlanOf(TwoActionModel(), parameters).runners_up.empty());
  parameters.refusal_threshold = 0.66;
  const Plan plan = PlanOf(TwoActionModel(), parameters);
  EXPECT_EQ(plan.status, PlanStatus::kRefused);
  EXPECT_EQ(plan.best.path, (Path{1, 0}));  // the best of the bad ones
  EXPECT_EQ(plan.best.rejection, Rejection::kLowScore);
  EXPECT_EQ(plan.low_score, 2);
  EXPECT_NE(plan.reason.find("0.648"), std::string::npos) << plan.reason;
}

TEST(PlanReader, TooFewSamplesGiveAnIncompletePlan) {
  TableModel model = TwoActionModel();
  model.At({0}).done = 0.05f;
  SearchParameters parameters;
  parameters.samples = 1;
  const Plan plan = PlanOf(model, parameters);
  EXPECT_EQ(plan.status, PlanStatus::kIncomplete);
  EXPECT_TRUE(plan.best.path.empty());
  EXPECT_EQ(plan.untried, 1);
  EXPECT_NE(plan.reason.find("samples"), std::string::npos) << plan.reason;
}

TEST(PlanReader, IncompleteShowsTheMostAdvancedFuture) {
  TableModel model = TwoActionModel();
  Search search(AnyOrder(2, 2), {}, {}, {});
  search.Deliver({}, model.Evaluate({}), 0);
  const std::vector<Path> asked = search.Advance(1, 0);
  ASSERT_EQ(asked, (std::vector<Path>{{0}}));
  // A rollout of another process went to {0} and ended there by its own lights.
  Search other(AnyOrder(2, 2), {}, {}, {{0, 0}, 2, 1, 1'000'000});
  PathTree& paths = const_cast<PathTree&>(other.paths());
  for (const PathId id : {kRoot, paths.Add(Path{0})}) {
    other.statistics().Begin(id);
    other.statistics().Complete(id, 0.5);
  }
  search.Deliver({0}, model.Evaluate({0}), 0);
  search.Merge(other.MakeBatch(10'000, 0), 0);
  const Plan plan = search.BestPlan();
  EXPECT_EQ(plan.status, PlanStatus::kIncomplete);
  EXPECT_EQ(plan.best.path, Path{0});
  EXPECT_FALSE(plan.best.complete);
}

TEST(PlanReader, DepthCutsThePlan) {
  SearchParameters parameters;
  parameters.depth = 1;
  const Plan plan = PlanOf(TwoActionModel(), parameters);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan.best.path, Path{0});  // 0.8 * 0.9 against 0.6 * 0.8
  EXPECT_FALSE(plan.best.complete);
}

TEST(PlanReader, NothingEvaluated) {
  Search search(AnyOrder(2, 2), {}, {}, {});
  EXPECT_EQ(search.BestPlan().status, PlanStatus::kNoEvaluation);
  EXPECT_FALSE(search.BestPlan().reason.empty());
}

TEST(PlanReader, EvaluatedButNeverVisitedDoesNotCount) {
  TableModel model = TwoActionModel();
  SearchParameters parameters;
  parameters.samples = 1;
  Search search(AnyOrder(2, 2), parameters, {}, {});
  RunSearch(&search, &model);
  search.Deliver({1}, model.Evaluate({1}), 0);
  search.Deliver({1, 0}, model.Evaluate({1, 0}), 0);
  EXPECT_EQ(search.BestPlan().best.path, (Path{0, 1}));
}

TEST(PlanReader, ListsAreCut) {
  SearchParameters parameters;
  parameters.listed_futures = 0;
  const Plan plan = PlanOf(TwoActionModel(), parameters);
  EXPECT_TRUE(plan.ok());
  EXPECT_TRUE(plan.runners_up.empty());
  EXPECT_EQ(plan.complete_futures, 2);
}

TEST(PlanReader, PrintsATable) {
  const std::string text = ToString(PlanOf(TwoActionModel()));
  EXPECT_NE(text.find("plan"), std::string::npos);
  EXPECT_NE(text.find("0.648"), std::string::npos) << text;
}

}  // namespace
}  // namespace prospect::planner
