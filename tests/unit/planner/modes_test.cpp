// Answers before the end, searching apart, leaves in flight: what a search does beside the
// algorithm itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

#include "planner/model_source.h"
#include "planner/scripted_model.h"
#include "planner/search.h"

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

// --- searching apart

TEST(Apart, WorkersDoTheirPartOfTheTotalAndTakeNothingFromOthers) {
  ScriptedModel model = Kind(7);
  SearchParameters parameters;
  parameters.samples = 50;
  parameters.sharing = false;
  parameters.workers = 4;
  Search a(AnyOrder(5, 3), parameters, {}, Worker(0));
  Search b(AnyOrder(5, 3), parameters, {}, Worker(1));
  Search observer(AnyOrder(5, 3), parameters, {}, Worker(2));
  Answer(&a, &model, a.Advance(1, 0));
  RunSearch(&b, &model);
  EXPECT_EQ(b.rollouts(), 13);
  a.NoteRequested({{1}}, 0, 2);
  EXPECT_EQ(a.Merge(b.MakeBatch(kPlenty, 0), 0), 0);
  RunSearch(&a, &model);
  EXPECT_EQ(a.Merge(b.MakeBatch(kPlenty, 0), 0), 0);
  EXPECT_EQ(a.total_rollouts(), 13);
  EXPECT_EQ(a.stop_reason(0), StopReason::kSamples);
  observer.Merge(a.MakeBatch(kPlenty, 0), 0);
  observer.Merge(b.MakeBatch(kPlenty, 0), 0);
  EXPECT_EQ(observer.total_rollouts(), 26);
  EXPECT_EQ(observer.stop_reason(0), StopReason::kRunning);
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

}  // namespace
}  // namespace prospect::planner
