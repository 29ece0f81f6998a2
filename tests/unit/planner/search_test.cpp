// The search as its owner sees it: what it asks for, what it does with what it hears, and when it
// ends.
#include "planner/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "planner/model_source.h"
#include "planner/scripted_model.h"
#include "tests/unit/planner/table_model.h"

namespace prospect::planner {
namespace {

constexpr std::size_t kPlenty = 1 << 20;

SearchParameters Samples(std::int64_t samples) {
  SearchParameters parameters;
  parameters.samples = samples;
  return parameters;
}

SearchIdentity Worker(int index) {
  return {{1, 1}, static_cast<std::uint64_t>(index) + 1, index, 1'000'000};
}

ScriptedModel Kind(std::uint64_t seed, int num_actions = 5) {
  return ScriptedModel({num_actions, seed, 0.0, 0.0, 0.0});
}

void Answer(Search* search, ModelSource* model, const std::vector<Path>& paths) {
  for (const Path& path : paths) search->Deliver(path, model->Evaluate(path), 0);
}

std::uint64_t TreeOf(std::uint64_t seed, int worker, const std::string& rule) {
  ScriptedModel model({6, 3, 0.2, 0.1, 0.1});
  SearchParameters parameters = Samples(200);
  parameters.seed = seed;
  parameters.rule = rule;
  SearchIdentity identity = Worker(worker);
  identity.writer = 1;
  Search search(AnyOrder(6, 4), parameters, {}, identity);
  RunSearch(&search, &model);
  return search.statistics().digest();
}

TEST(Search, OneWorkerWithOneSeedGivesOneTree) {
  for (const std::string& rule : SelectionRuleNames()) {
    EXPECT_EQ(TreeOf(1, 0, rule), TreeOf(1, 0, rule)) << rule;
  }
  EXPECT_NE(TreeOf(1, 0, "random"), TreeOf(2, 0, "random"));
  EXPECT_NE(TreeOf(1, 0, "random"), TreeOf(1, 1, "random"));
  EXPECT_NE(TreeOf(1, 0, "paper"), TreeOf(1, 0, "puct"));
}

TEST(Search, LooksToTheEndOfTheLongestPlan) {
  ScriptedModel model({kMaxActions, 3, 0.0, 0.0, 0.0});
  Search search(AnyOrder(kMaxActions, kMaxPathLength), Samples(3), {}, Worker(0));
  RunSearch(&search, &model);
  EXPECT_EQ(search.rollouts(), 3);
  EXPECT_EQ(search.BestPlan().best.steps.size(), static_cast<std::size_t>(kMaxPathLength));
}

TEST(Search, RefusesBadArguments) {
  SearchParameters bad;
  bad.rule = "none";
  EXPECT_THROW(Search(AnyOrder(2, 2), bad, {}, {}), std::invalid_argument);
  EXPECT_THROW(Search(TaskRules{}, {}, {}, {}), std::invalid_argument);
  EXPECT_THROW(Search(AnyOrder(2, 2), {}, {7}, {}), std::invalid_argument);
}

TEST(Search, AsksForTheRootFirstAndWaits) {
  ScriptedModel model = Kind(1);
  Search search(AnyOrder(5, 3), Samples(10), {}, Worker(0));
  EXPECT_EQ(search.Advance(2, 0), (std::vector<Path>{{}}));
  EXPECT_EQ(search.waiting(), 1);
  EXPECT_TRUE(search.Advance(1, 0).empty());  // asked for already
  EXPECT_EQ(search.waiting(), 1);
  EXPECT_EQ(search.statistics().totals(kRoot).in_flight, 1);  // those given up left no trace
}

TEST(Search, KeepsTheWantedNumberInFlightOnDifferentPaths) {
  ScriptedModel model = Kind(1, 9);
  Search search(AnyOrder(9, 4), Samples(1000), {}, Worker(0));
  Answer(&search, &model, search.Advance(4, 0));
  for (int step = 0; step < 40; ++step) {
    const std::vector<Path> asked = search.Advance(std::max(0, 4 - search.waiting()), 0);
    EXPECT_EQ(std::set<Path>(asked.begin(), asked.end()).size(), asked.size());
    EXPECT_EQ(search.waiting(), 4);
    EXPECT_EQ(asked.size(), 4u);
    Answer(&search, &model, asked);
  }
}

TEST(Search, ARolloutWalksOnOverSeveralEvaluations) {
  TableModel model = TwoActionModel();
  Search search(AnyOrder(2, 2), Samples(1), {}, Worker(0));
  Answer(&search, &model, search.Advance(1, 0));
  const std::vector<Path> first = search.Advance(0, 0);
  EXPECT_EQ(first, (std::vector<Path>{{0}}));
  Answer(&search, &model, first);
  const std::vector<Path> second = search.Advance(0, 0);
  EXPECT_EQ(second, (std::vector<Path>{{0, 1}}));
  EXPECT_EQ(search.rollouts(), 0);
  Answer(&search, &model, second);
  EXPECT_TRUE(search.Advance(0, 0).empty());
  EXPECT_EQ(search.rollouts(), 1);
  EXPECT_EQ(search.evaluations(), 3);
  EXPECT_TRUE(search.finished(0));
  EXPECT_EQ(search.statistics().totals(kRoot).in_flight, 0);
}

TEST(Search, SamplesCountRolloutsOfAllWorkersInFlightOnesToo) {
  ScriptedModel model = Kind(2);
  Search a(AnyOrder(5, 3), Samples(10), {}, Worker(0));
  Search b(AnyOrder(5, 3), Samples(10), {}, Worker(1));
  for (int i = 0; i < 8; ++i) b.statistics().Begin(kRoot);
  for (int i = 0; i < 6; ++i) b.statistics().Complete(kRoot, 0.5);
  a.Merge(b.MakeBatch(kPlenty, 0), 0);
  RunSearch(&a, &model);
  EXPECT_EQ(a.rollouts(), 2);
  EXPECT_EQ(a.total_rollouts(), 8);
  EXPECT_EQ(a.stop_reason(0), StopReason::kSamples);
  // Worker b dies with two in flight: after its lease they are made up for.
  a.statistics().ExpireLeases(1'000'001);
  EXPECT_EQ(a.stop_reason(0), StopReason::kRunning);
  a.MakeBatch(kPlenty, 1'000'001);  // claims them
  RunSearch(&a, &model);
  EXPECT_EQ(a.total_rollouts(), 10);
}

TEST(Search, DeadlineAndStop) {
  ScriptedModel model = Kind(2);
  SearchParameters parameters = Samples(100);
  parameters.deadline_us = 500;
  Search search(AnyOrder(5, 3), parameters, {}, Worker(0));
  Answer(&search, &model, search.Advance(1, 499));
  EXPECT_EQ(search.Advance(1, 499).size(), 2u);
  EXPECT_EQ(search.stop_reason(500), StopReason::kDeadline);
  EXPECT_TRUE(search.Advance(2, 500).empty());
  EXPECT_FALSE(search.finished(500));
  search.Stop();
  EXPECT_EQ(search.stop_reason(0), StopReason::kStopped);
  EXPECT_TRUE(search.finished(500));
  EXPECT_EQ(search.statistics().totals(kRoot).in_flight, 0);
  EXPECT_TRUE(search.Advance(2, 0).empty());
  EXPECT_TRUE(search.MakeBatch(kPlenty, 0).totals.finished);
}

TEST(Search, AbandonedPathsMayBeAskedForAgain) {
  ScriptedModel model = Kind(2);
  Search search(AnyOrder(5, 3), Samples(100), {}, Worker(0));
  EXPECT_EQ(search.Advance(1, 0).size(), 1u);
  search.Abandon({});
  EXPECT_EQ(search.waiting(), 0);
  EXPECT_EQ(search.statistics().totals(kRoot).in_flight, 0);
  EXPECT_EQ(search.Advance(1, 0), (std::vector<Path>{{}}));
  search.Abandon({3, 3});  // never heard of: nothing happens
}

// Q = 0.4 and 0.3: alone it takes action 0 (4 against 3); with one visit in flight there, 4 / 2
// against 3.
TEST(Search, AnothersRequestCountsAsInFlightAtOnce) {
  TableModel model = TwoActionModel();
  model.At({}).q = {0.4f, 0.3f};
  Search alone(AnyOrder(2, 2), Samples(100), {}, Worker(0));
  Answer(&alone, &model, {{}});
  EXPECT_EQ(alone.Advance(1, 0), (std::vector<Path>{{0}}));
  Search second(AnyOrder(2, 2), Samples(100), {}, Worker(0));
  Answer(&second, &model, {{}});
  second.NoteRequested({{0}}, 0);
  EXPECT_EQ(second.Advance(1, 0), (std::vector<Path>{{1}}));
}

// The other worker's own row and its request are one visit in flight, not two.
TEST(Search, ARequestAndItsRowAreCountedOnce) {
  TableModel model = TwoActionModel();
  model.At({}).q = {0.5f, 0.2f};  // one in flight: 2.5 against 2; two: 1.67 against 2
  Search other(AnyOrder(2, 2), Samples(100), {}, Worker(1));
  Answer(&other, &model, {{}});
  Search search(AnyOrder(2, 2), Samples(100), {}, Worker(0));
  Answer(&search, &model, {{}});
  search.NoteRequested(other.Advance(1, 0), 0);
  search.Merge(other.MakeBatch(kPlenty, 0), 0);
  Answer(&search, &model, {{0}});
  EXPECT_EQ(search.Advance(1, 0), (std::vector<Path>{{0, 1}}));
}

TEST(Search, AnothersRequestIsNotRepeatedBeforePatienceEnds) {
  TableModel model = TwoActionModel();
  SearchParameters parameters = Samples(100);
  parameters.patience_us = 1000;
  Search search(AnyOrder(2, 2), parameters, {}, Worker(0));
  search.NoteRequested({{}}, 0);
  EXPECT_TRUE(search.Advance(2, 999).empty());
  EXPECT_EQ(search.waiting(), 0);
  EXPECT_EQ(search.Advance(2, 1000), (std::vector<Path>{{}}));
  search.NoteRequested({{}}, 1000);  // does not take it away
  Answer(&search, &model, {{}});
  EXPECT_EQ(search.evaluations(), 1);
}

TEST(Search, EvaluationsOfOthersNeedNoRequest) {
  TableModel model = TwoActionModel();
  Search search(AnyOrder(2, 2), Samples(1), {}, Worker(0));
  Answer(&search, &model, {{}, {0}, {0, 1}});
  EXPECT_TRUE(search.Advance(1, 0).empty());
  EXPECT_EQ(search.rollouts(), 1);
  EXPECT_EQ(search.evaluations(), 0);
  EXPECT_EQ(search.known_evaluations(), 3);
}

TEST(Search, DeliverRefusesWhatTheTaskExcludes) {
  TableModel model = TwoActionModel();
  Search search(AnyOrder(2, 2), Samples(1), {}, Worker(0));
  const Evaluation good = model.Evaluate({});
  EXPECT_EQ(search.Deliver({}, good, 0), Delivery::kNew);
  EXPECT_EQ(search.Deliver({}, good, 0), Delivery::kDuplicate);
  Evaluation lower = good;
  lower.value = 0.4f;
  EXPECT_EQ(search.Deliver({}, lower, 0), Delivery::kReplaced);
  EXPECT_EQ(search.Deliver({0, 0}, good, 0), Delivery::kRefused);
  EXPECT_EQ(search.Deliver({2}, good, 0), Delivery::kRefused);
  EXPECT_EQ(search.Deliver(Path(40, 1), good, 0), Delivery::kRefused);
  Evaluation bad = good;
  bad.q.pop_back();
  EXPECT_EQ(search.Deliver({0}, bad, 0), Delivery::kRefused);
  EXPECT_EQ(search.known_evaluations(), 1);
}

TEST(Search, ExecutedActionsAreMasked) {
  ScriptedModel model = Kind(4);
  SearchParameters parameters = Samples(500);
  parameters.c = 1000;  // to every corner
  Search search(AnyOrder(5, 3), parameters, {2}, Worker(0));
  RunSearch(&search, &model);
  EXPECT_EQ(search.stop_reason(0), StopReason::kExhausted);
  EXPECT_EQ(search.evaluations(), 1 + 4 + 12);
  for (const StatisticsRow& row : search.statistics().AllRows()) {
    EXPECT_EQ(std::count(row.path.begin(), row.path.end(), 2), 0);
    EXPECT_LE(row.path.size(), 2u);
  }
  EXPECT_EQ(search.BestPlan().best.path.size(), 2u);
  EXPECT_TRUE(search.BestPlan().best.complete);
}

TEST(Search, NothingLeftToDoIsACompleteEmptyPlan) {
  ScriptedModel model = Kind(4);
  Search search(AnyOrder(5, 2), Samples(5), {2, 3}, Worker(0));
  RunSearch(&search, &model);
  EXPECT_EQ(search.evaluations(), 1);
  EXPECT_TRUE(search.BestPlan().ok());
  EXPECT_TRUE(search.BestPlan().best.path.empty());
}

SearchParameters BestFirst(std::int64_t samples) {
  SearchParameters parameters = Samples(samples);
  parameters.UseRule("best_first");
  return parameters;
}

TEST(Search, OnlyARuleThatRanksByDoubtItselfCutsLess) {
  SearchParameters parameters = BestFirst(1);
  EXPECT_LT(parameters.c_done, SearchParameters{}.c_done);
  EXPECT_EQ(parameters.v_failed, 0);
  parameters.UseRule("paper");
  EXPECT_EQ(parameters.c_done, SearchParameters{}.c_done);
  EXPECT_EQ(parameters.v_failed, SearchParameters{}.v_failed);
  parameters.v_failed = 0.2;
  parameters.UseRule("best_first");
  EXPECT_EQ(parameters.v_failed, 0.2) << "somebody asked for it";
  EXPECT_THROW(parameters.UseRule("none"), std::invalid_argument);
}

// Q says 0.4 of action 0 and 0.2 of action 1; f of action 0 turns out to be 0.3, so that nothing
// below it is as good as action 1, which nobody has tried.
TEST(Search, BestFirstGoesOnWhereTheMostPromisingOpenFutureIs) {
  TableModel model = TwoActionModel();
  model.Set({0}, 0.8f, 0.3f, {0.0f, 0.5f, 0.5f}, {1, 1, 1});
  model.Set({}, 0.5f, 1.0f, {0.4f, 0.2f, 0.1f}, {1, 1, 1});
  model.Set({0, 1}, 0.5f, 0.5f, {0, 0, 0}, {1, 1, 1});
  model.Set({0, 2}, 0.5f, 0.5f, {0, 0, 0}, {1, 1, 1});
  Search search(AnyOrder(3, 2), BestFirst(100), {}, Worker(0));
  Answer(&search, &model, {{}, {0}});
  EXPECT_EQ(search.Advance(1, 0), (std::vector<Path>{{1}}));  // 0.2 against 0.3 times 0.5
  const std::vector<Path> next = search.Advance(1, 0);        // {1} is taken: below {0}
  ASSERT_EQ(next.size(), 1u);
  EXPECT_EQ(next.front().front(), 0);
  EXPECT_EQ(search.waiting(), 2);
}

TEST(Search, BestFirstRolloutsNeverRepeatEachOther) {
  ScriptedModel model({5, 7, 0.2, 0.1, 0.1});
  Search search(AnyOrder(5, 4), BestFirst(1000), {}, Worker(0));
  RunSearch(&search, &model);
  EXPECT_EQ(search.stop_reason(0), StopReason::kExhausted);
  std::int64_t ends = 0;
  for (const StatisticsRow& row : search.statistics().AllRows()) {
    ends += row.path.size() == 4;
    EXPECT_TRUE(row.path.size() < 4 || row.visits == 1) << ToString(row.path);
  }
  EXPECT_GT(ends, 10);
  EXPECT_LE(search.rollouts(), search.evaluations());
}

TEST(Search, MissingEvaluationsNamesVisitedPathsOnly) {
  ScriptedModel model = Kind(6);
  Search worker(AnyOrder(5, 3), Samples(20), {}, Worker(0));
  Search observer(AnyOrder(5, 3), Samples(20), {}, Worker(1));
  RunSearch(&worker, &model);
  observer.Merge(worker.MakeBatch(kPlenty, 0), 0);
  const std::vector<Path> missing = observer.MissingEvaluations(1000);
  EXPECT_EQ(static_cast<std::int64_t>(missing.size()), worker.known_evaluations());
  EXPECT_EQ(missing.front(), Path{});
  EXPECT_EQ(observer.MissingEvaluations(3).size(), 3u);
  Answer(&observer, &model, missing);
  EXPECT_TRUE(observer.MissingEvaluations(1000).empty());
  EXPECT_EQ(observer.BestPlan().best.path, worker.BestPlan().best.path);
  EXPECT_EQ(observer.BestPlan().best.visits, worker.BestPlan().best.visits);
}

}  // namespace
}  // namespace prospect::planner
