#include "planner/gumbel_rule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "planner/model_source.h"
#include "planner/scripted_model.h"
#include "planner/search.h"

namespace prospect::planner {
namespace {

std::vector<std::int64_t> Schedule(int actions, int samples) {
  std::vector<std::int64_t> due;
  for (int i = 0; i < samples; ++i) due.push_back(VisitsDue(i, actions, samples));
  return due;
}

TEST(VisitsDue, HalvesTheActionsPhaseByPhase) {
  // Four actions, 16 visits: two phases of 8 visits, two each for four, then four each for two.
  EXPECT_EQ(Schedule(4, 16),
            (std::vector<std::int64_t>{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}));
  EXPECT_EQ(Schedule(1, 3), (std::vector<std::int64_t>{0, 1, 2}));
  // Fewer visits than actions: each of the first few once.
  EXPECT_EQ(Schedule(16, 5), (std::vector<std::int64_t>{0, 0, 0, 0, 0}));
}

ChildView Child(std::int64_t visits, double mean, std::uint64_t draw) {
  ChildView child{};
  child.q = 0.5;
  child.visits = visits;
  child.mean = mean;
  child.draw = draw;
  return child;
}

TEST(GumbelRule, BelowTheRootVisitsFollowTheImprovedPolicy) {
  const auto rule = MakeGumbelRule();
  const ChildView children[] = {Child(3, 0.52, 0), Child(1, 0.5, 0)};
  ParentView parent{4, 0, 0.5, 1.0};
  double scores[2];
  rule->ScoreAll(parent, children, scores);
  // sigma = 50 + 3: logits differ by 53 * 0.02.
  const double first = 1 / (1 + std::exp(-53 * 0.02));
  EXPECT_NEAR(scores[0], first - 3.0 / 5, 1e-12);
  EXPECT_NEAR(scores[1], (1 - first) - 1.0 / 5, 1e-12);
}

// Visits of the root's children, most first.
std::vector<std::int64_t> RootVisits(const Search& search, int actions) {
  std::vector<std::int64_t> visits;
  for (int a = 0; a < actions; ++a) {
    visits.push_back(search.statistics().totals(search.paths().Find(kRoot, a)).visits);
  }
  std::sort(visits.rbegin(), visits.rend());
  return visits;
}

SearchParameters Gumbel(std::int64_t samples) {
  SearchParameters parameters;
  parameters.rule = "gumbel";
  parameters.samples = samples;
  parameters.seed = 5;
  return parameters;
}

// The whole shape of the root: 8 actions, 24 visits: 1 each, then 2 each for four, 4 each for two.
TEST(GumbelRule, TheRootIsHalvedExactly) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    ScriptedModel model({8, seed, 0, 0, 0});
    Search search(AnyOrder(8, 3), Gumbel(24), {}, {});
    RunSearch(&search, &model);
    EXPECT_EQ(RootVisits(search, 8), (std::vector<std::int64_t>{7, 7, 3, 3, 1, 1, 1, 1}));
  }
}

// Three workers that hear each other's counts, on one tree; the root's visits in the end.
std::vector<std::int64_t> VisitsOfThree(std::uint64_t seed) {
  ScriptedModel model({8, seed, 0, 0, 0});
  std::vector<std::unique_ptr<Search>> workers;
  for (int i = 0; i < 3; ++i) {
    const SearchIdentity identity{{1, 1}, static_cast<std::uint64_t>(i) + 1, i, 1'000'000};
    workers.push_back(std::make_unique<Search>(AnyOrder(8, 3), Gumbel(24), Path{}, identity));
  }
  const auto finished = [](const auto& worker) { return worker->finished(0); };
  for (int step = 0; step < 500; ++step) {
    if (std::all_of(workers.begin(), workers.end(), finished)) break;
    for (auto& worker : workers) {
      for (auto& other : workers) other->Merge(worker->MakeBatch(1 << 20, 0), 0);
      for (const Path& path : worker->Advance(worker->waiting() > 0 ? 0 : 1, 0)) {
        for (auto& other : workers) other->Deliver(path, model.Evaluate(path), 0);
      }
      for (auto& other : workers) other->Merge(worker->MakeBatch(1 << 20, 0), 0);
    }
  }
  EXPECT_TRUE(std::all_of(workers.begin(), workers.end(), finished));
  return RootVisits(*workers[0], 8);
}

// They go through the same phases, if not to the visit: a lone worker gives the last two 14 of 24.
TEST(GumbelRule, WorkersShareThePhases) {
  constexpr int kSeeds = 12;
  std::int64_t last_two = 0, first_four = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<std::int64_t> visits = VisitsOfThree(seed);
    last_two += visits[0] + visits[1];
    first_four += visits[4] + visits[5] + visits[6] + visits[7];
    EXPECT_LE(std::count(visits.begin(), visits.end(), 0), 1);
  }
  EXPECT_GE(last_two, 12 * kSeeds);
  EXPECT_LE(first_four, 6 * kSeeds);
}

}  // namespace
}  // namespace prospect::planner
