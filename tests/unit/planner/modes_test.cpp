// Ways of ending, sharing modes, warm start: what a search does beside the algorithm itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

#include "planner/model_source.h"
#include "planner/scripted_model.h"
#include "planner/search.h"
#include "planner/warm_start.h"
#include "tests/unit/planner/table_model.h"

namespace prospect::planner {
namespace {

constexpr std::size_t kPlenty = 1 << 20;

SearchIdentity Worker(int index) {
  return {{1, 1}, static_cast<std::uint64_t>(index) + 1, index, 1'000'000};
}

ScriptedModel Kind(std::uint64_t seed) { return ScriptedModel({5, seed, 0.0, 0.0, 0.0}); }

void Answer(Search* search, ModelSource* model, const std::vector<Path>& paths) {
  for (const Path& path : paths) search->Deliver(path, model->Evaluate(path), 0);
}

// --- ending

TEST(Stopping, EvaluationsAreNeverExceeded) {
  for (const int leaves : {1, 3}) {
    ScriptedModel model = Kind(2);
    SearchParameters parameters;
    parameters.samples = 1000;
    parameters.evaluations = 17;
    Search search(AnyOrder(5, 3), parameters, {}, Worker(0));
    RunSearch(&search, &model, leaves);
    EXPECT_EQ(search.stop_reason(0), StopReason::kEvaluations);
    EXPECT_EQ(search.known_evaluations(), 17);
    EXPECT_EQ(search.statistics().totals(kRoot).in_flight, 0);
    EXPECT_TRUE(search.BestPlan().ok());
  }
}

TEST(Stopping, AProvenDecisionIsTheOneOfTheWholeSearch) {
  int sooner = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    ScriptedModel model({5, seed, 0.2, 0.1, 0.1}), same({5, seed, 0.2, 0.1, 0.1});
    SearchParameters parameters;
    parameters.samples = 2000;
    parameters.skip_exhausted = true;
    Search whole(AnyOrder(5, 3), parameters, {}, Worker(0));
    RunSearch(&whole, &model);
    parameters.stop_when_proven = true;
    Search proven(AnyOrder(5, 3), parameters, {}, Worker(0));
    RunSearch(&proven, &same);
    ASSERT_EQ(whole.stop_reason(0), StopReason::kExhausted);
    EXPECT_LE(proven.rollouts(), whole.rollouts());
    sooner += proven.stop_reason(0) == StopReason::kSettled ? 1 : 0;
    if (!whole.BestPlan().ok()) continue;
    EXPECT_EQ(proven.BestPlan().best.path.front(), whole.BestPlan().best.path.front());
  }
  EXPECT_GE(sooner, 10);
}

TEST(Stopping, AStableDecisionEndsTheSearch) {
  ScriptedModel model = Kind(4);
  SearchParameters parameters;
  parameters.samples = 100'000;
  parameters.stop_when_stable = 50;
  Search search(AnyOrder(5, 3), parameters, {}, Worker(0));
  RunSearch(&search, &model);
  EXPECT_EQ(search.stop_reason(0), StopReason::kSettled);
  EXPECT_GE(search.rollouts(), 50);
  EXPECT_LT(search.rollouts(), 1000);
}

TEST(Stopping, ThereIsAnAnswerAtAnyTime) {
  ScriptedModel model = Kind(4);
  SearchParameters parameters;
  parameters.samples = 60;
  Search search(AnyOrder(5, 3), parameters, {}, Worker(0));
  double best = 0;
  for (int step = 0; step < 1000 && !search.finished(0); ++step) {
    Answer(&search, &model, search.Advance(std::max(0, 1 - search.waiting()), 0));
    const Plan plan = search.BestPlan();
    EXPECT_EQ(plan.ok(), search.rollouts() > 0);
    const double score = plan.ok() ? plan.best.score : 0;
    EXPECT_GE(score, best);
    best = score;
  }
  EXPECT_TRUE(search.finished(0));
}

// --- sharing modes

TEST(SharingModes, ApartWorkersDoTheirPartOfTheTotal) {
  for (const Sharing sharing : {Sharing::kMergeAtEnd, Sharing::kNone}) {
    ScriptedModel model = Kind(7);
    SearchParameters parameters;
    parameters.samples = 50;
    parameters.sharing = sharing;
    parameters.workers = 4;
    Search a(AnyOrder(5, 3), parameters, {}, Worker(0));
    Search b(AnyOrder(5, 3), parameters, {}, Worker(1));
    Search observer(AnyOrder(5, 3), parameters, {}, Worker(2));
    Answer(&a, &model, a.Advance(1, 0));
    RunSearch(&b, &model);
    EXPECT_EQ(b.rollouts(), 13);
    a.NoteRequested({{1}}, 0, 2);
    EXPECT_EQ(a.Merge(b.MakeBatch(kPlenty, 0), 0), 0);  // not while it searches
    RunSearch(&a, &model);
    EXPECT_EQ(a.total_rollouts(), 13);
    a.Merge(b.MakeBatch(kPlenty, 0), 0);
    EXPECT_EQ(a.total_rollouts(), sharing == Sharing::kNone ? 13 : 26);
    EXPECT_EQ(a.stop_reason(0), StopReason::kSamples);
    observer.Merge(a.MakeBatch(kPlenty, 0), 0);
    observer.Merge(b.MakeBatch(kPlenty, 0), 0);
    EXPECT_EQ(observer.total_rollouts(), 26);
    EXPECT_EQ(observer.stop_reason(0), StopReason::kRunning);
  }
}

TEST(SharingModes, NamesComeBack) {
  for (const Sharing sharing : {Sharing::kFull, Sharing::kMergeAtEnd, Sharing::kNone}) {
    EXPECT_EQ(SharingFrom(ToString(sharing)), sharing);
  }
  EXPECT_THROW(SharingFrom("some"), std::invalid_argument);
}

// --- leaves in flight

TEST(Collisions, AnAdvanceGivesUpAfterItsBudgetAndLeavesNoTrace) {
  ScriptedModel model = Kind(3);
  SearchParameters parameters;
  parameters.collisions = 3;
  Search search(AnyOrder(5, 3), parameters, {}, Worker(0));
  search.NoteRequested({{}}, 0, 2);  // everything waits for the root
  EXPECT_TRUE(search.Advance(4, 0).empty());
  EXPECT_EQ(search.waiting(), 0);
  EXPECT_EQ(search.statistics().own_in_flight(kRoot), 0);
}

TEST(Collisions, OfTwoThatAskForOnePathOneGoesElsewhere) {
  ScriptedModel model = Kind(3);
  Search low(AnyOrder(5, 3), {}, {}, Worker(0)), high(AnyOrder(5, 3), {}, {}, Worker(1));
  EXPECT_EQ(low.Advance(1, 0), high.Advance(1, 0));
  low.NoteRequested({{}}, 0, 2);
  high.NoteRequested({{}}, 0, 1);
  EXPECT_EQ(low.waiting(), 1);
  EXPECT_EQ(high.waiting(), 0);
}

// One answer ends the rollouts of three workers; none has heard of the others' next ones.
TEST(Collisions, WorkersFreedTogetherGoDifferentWays) {
  ScriptedModel model({8, 3, 0.0, 0.0, 0.0});
  std::vector<std::unique_ptr<Search>> workers;
  for (int i = 0; i < 3; ++i) {
    workers.push_back(
        std::make_unique<Search>(AnyOrder(8, 1), SearchParameters{}, Path{}, Worker(i)));
    workers[i]->Advance(0, 0);
    workers[i]->Deliver({}, model.Evaluate({}), 0);
  }
  std::set<Path> asked;
  for (auto& worker : workers) {
    for (const Path& path : worker->Advance(1, 0)) {
      asked.insert(path);
      for (auto& other : workers) {
        if (other != worker) other->NoteRequested({path}, 0, worker->statistics().writer());
      }
    }
  }
  ASSERT_EQ(asked.size(), 3u);
  for (auto& worker : workers) {
    for (const Path& path : asked) worker->Deliver(path, model.Evaluate(path), 0);
  }
  std::set<Path> next;
  for (auto& worker : workers) {
    for (const Path& path : worker->Advance(1, 0)) next.insert(path);
  }
  EXPECT_EQ(next.size(), 3u);
}

// --- warm start

TEST(WarmStart, LendsHintsAndOrderButNoCounts) {
  ScriptedModel model = Kind(9);
  SearchParameters parameters;
  parameters.samples = 100;
  Search before(AnyOrder(5, 3), parameters, {}, Worker(0));
  RunSearch(&before, &model);
  const auto first = static_cast<std::uint8_t>(before.BestPlan().best.path.front());
  Search warm(AnyOrder(5, 3), parameters, {first}, Worker(0));
  warm.WarmStart(before);
  EXPECT_EQ(warm.total_rollouts(), 0);
  EXPECT_EQ(warm.known_evaluations(), 0);
  const std::vector<Path> asked = warm.Advance(4, 0);
  ASSERT_EQ(asked.size(), 4u);  // the root, and what the former search visited most
  EXPECT_EQ(asked.front(), Path{});
  EXPECT_EQ(warm.waiting(), 1);
  EXPECT_EQ(warm.statistics().totals(kRoot).in_flight, 1);
  Answer(&warm, &model, asked);
  RunSearch(&warm, &model);
  EXPECT_EQ(warm.stop_reason(0), StopReason::kExhausted);  // every plan of the two steps left
  EXPECT_EQ(warm.known_evaluations(), 1 + 4 + 12);

  Search unrelated(AnyOrder(5, 3), parameters, {first, 9 % 5}, Worker(0));
  unrelated.WarmStart(before);
  EXPECT_EQ(unrelated.Advance(4, 0), (std::vector<Path>{{}}));
}

TEST(WarmStart, AHintIsTheBestPlanThroughTheAction) {
  TableModel model = TwoActionModel();
  SearchParameters parameters;
  parameters.samples = 20;
  Search search(AnyOrder(2, 2), parameters, {}, Worker(0));
  RunSearch(&search, &model);
  const auto hints = ReadWarmHints(search.paths(), search.evaluation_table(), search.statistics(),
                                   /*action=*/1, /*plan_depth=*/2, /*limit=*/8);
  ASSERT_EQ(hints.size(), 1u);
  EXPECT_EQ(hints[0].path, Path{0});
  EXPECT_FLOAT_EQ(static_cast<float>(hints[0].score), 0.81f);  // V f of the last step: 0.9 0.9
}

}  // namespace
}  // namespace prospect::planner
