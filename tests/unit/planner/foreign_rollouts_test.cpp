// What workers know of each other's visits between two rows: each counts once, and at once.
#include "planner/foreign_rollouts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <string>

#include "planner/scripted_tree.h"
#include "planner/search.h"

namespace prospect::planner {
namespace {

constexpr SearchId kSearch{42, 1};
constexpr std::size_t kPlenty = 1 << 20;

SharedStatisticsOptions Options(std::uint64_t writer) {
  SharedStatisticsOptions options;
  options.search = kSearch;
  options.writer = writer;
  return options;
}

// A worker's table, and where it thinks that others' rollouts are.
struct Listener {
  explicit Listener(std::uint64_t writer)
      : paths(4), statistics(&paths, Options(writer)), foreign(&paths, &statistics) {}
  void Hear(std::uint64_t writer, const Path& path, std::int64_t now_us = 0) {
    foreign.Hear(writer, paths.Add(path), answered, now_us);
  }
  void Visit(const Path& path) {
    for (PathId id = paths.Add(path); id != kNoPath; id = paths.parent(id)) {
      statistics.Begin(id);
      statistics.Complete(id, 0.5);
    }
  }
  std::int64_t Announced(const Path& path) const {
    return statistics.totals(paths.Find(path)).announced;
  }

  PathTree paths;
  SharedStatistics statistics;
  ForeignRollouts foreign;
  bool answered = false;
};

TEST(ForeignRollouts, CountOnceOnTheirWholePath) {
  Listener here(1);
  here.Hear(5, {1});
  here.foreign.Answer(here.paths.Find({1}));
  here.Hear(5, {1, 2, 0});  // the same rollout, further on
  here.Hear(6, {3});
  EXPECT_EQ(here.Announced({}), 2);
  EXPECT_EQ(here.Announced({1}), 1);
  EXPECT_EQ(here.Announced({1, 2}), 1);
  EXPECT_EQ(here.Announced({1, 2, 0}), 1);
  EXPECT_EQ(here.Announced({3}), 1);
  here.Hear(5, {1, 2, 1});  // another one
  EXPECT_EQ(here.Announced({1, 2}), 2);
  EXPECT_EQ(here.Announced({}), 3);
  here.Hear(1, {2});  // one's own request, brought back by the bus
  EXPECT_EQ(here.Announced({}), 3);
}

TEST(ForeignRollouts, ARequestHeardAgainChangesNothing) {
  Listener here(1);
  for (const Path& path : {Path{1}, Path{1}, Path{1, 2}, Path{1}, Path{1, 2}}) here.Hear(5, path);
  EXPECT_EQ(here.Announced({}), 1);
  EXPECT_EQ(here.Announced({1}), 1);
  EXPECT_EQ(here.Announced({1, 2}), 1);
}

TEST(ForeignRollouts, OfTwoThatWaitForOnePathTheLowerStays) {
  for (const bool lower_first : {true, false}) {
    Listener here(1);
    here.Hear(7, {1});  // the rollout that is to be given up has come from here
    here.foreign.Answer(here.paths.Find({1}));
    here.Hear(lower_first ? 5 : 7, {1, 2});
    here.Hear(lower_first ? 7 : 5, {1, 2});
    EXPECT_EQ(here.Announced({1, 2}), 1);
    EXPECT_EQ(here.Announced({1}), 1);
    EXPECT_EQ(here.Announced({}), 1);
    here.foreign.GiveUp(7, here.paths.Find({1, 2}));
    EXPECT_EQ(here.Announced({}), 1);
    here.foreign.GiveUp(5, here.paths.Find({1, 2}));
    EXPECT_EQ(here.Announced({}), 0);
  }
}

// Whoever asks for what is known already heard the answer late: both rollouts go on.
TEST(ForeignRollouts, BothCountWhereThePathIsAnswered) {
  Listener here(1);
  here.answered = true;
  here.Hear(5, {1, 2});
  here.Hear(7, {1, 2});
  EXPECT_EQ(here.Announced({1, 2}), 2);
}

TEST(ForeignRollouts, ThoseNeverAnsweredAreForgotten) {
  Listener here(1);
  here.Hear(5, {1}, 1'000'000);
  here.foreign.Answer(here.paths.Find({1}));
  here.Hear(6, {2}, 1'000'000);
  here.Hear(7, {3}, 2'000'000);
  here.foreign.Forget(1'000'001);
  EXPECT_EQ(here.Announced({1}), 1);  // a visit, whoever made it
  EXPECT_EQ(here.Announced({2}), 0);
  EXPECT_EQ(here.Announced({3}), 1);
  here.Hear(8, {2}, 2'000'000);  // and block nobody
  EXPECT_EQ(here.Announced({2}), 1);
}

TEST(Announced, ARowOfTheWritersOwnCoversThem) {
  Listener here(1), there(5);
  here.Hear(5, {1, 2});
  here.Hear(5, {1, 3});
  there.Visit({1, 2});
  const StatisticsBatch batch = there.statistics.MakeBatch(kPlenty, 0);
  here.statistics.Merge(batch, 0);
  EXPECT_EQ(here.Announced({1, 2}), 0);
  EXPECT_EQ(here.statistics.totals(here.paths.Find({1, 2})).visits, 1);
  EXPECT_EQ(here.Announced({1, 3}), 1);  // no row of that yet
  EXPECT_EQ(here.Announced({1}), 0);
  here.Hear(5, {1, 0});
  here.statistics.Merge(batch, 0);  // repeated: older than what was heard since
  EXPECT_EQ(here.Announced({1}), 1);
}

TEST(Announced, ARelayedRowTakesOffWhatItAdds) {
  Listener here(1), there(5), relay(6);
  there.Visit({1, 2});
  relay.statistics.Merge(there.statistics.MakeBatch(kPlenty, 0), 0);
  here.Hear(5, {1, 2});
  here.Hear(5, {1, 3});
  here.statistics.Merge(relay.statistics.MakeBatch(kPlenty, 0), 0);
  EXPECT_EQ(here.statistics.totals(here.paths.Find({1})).visits, 1);
  EXPECT_EQ(here.Announced({1}), 1);
  EXPECT_EQ(here.Announced({1, 2}), 0);
  EXPECT_EQ(here.Announced({1, 3}), 1);
}

TEST(Announced, EndsWithTheLease) {
  Listener here(1), there(5);
  here.statistics.Merge(there.statistics.MakeBatch(kPlenty, 0), 0);
  here.Hear(5, {1, 2});
  here.statistics.ExpireLeases(900'000);
  EXPECT_EQ(here.Announced({1}), 1);
  here.statistics.ExpireLeases(1'100'000);
  EXPECT_EQ(here.Announced({1}), 0);
  here.foreign.GiveUp(5, here.paths.Find({1, 2}));
  EXPECT_EQ(here.Announced({1}), 0);  // not below zero
}

// Workers in a big tree that hear every request and answer, and rows only as far as a few bytes and
// a lossy bus let them.
class Crew {
 public:
  static constexpr std::int64_t kSamples = 300;

  Crew(int workers, double loss, std::uint64_t seed)
      : loss_(loss), tree_{seed}, random_(static_cast<unsigned>(seed)) {
    SearchParameters parameters;
    parameters.samples = kSamples;
    parameters.seed = seed;
    for (int i = 0; i < workers; ++i) {
      const SearchIdentity identity{kSearch, 100 + static_cast<std::uint64_t>(i), i, 1'000'000'000};
      searches.push_back(
          std::make_unique<Search>(ScriptedTree::Rules(), parameters, Path{}, identity));
    }
  }

  bool Finished() const {
    return std::all_of(searches.begin(), searches.end(),
                       [this](const auto& search) { return search->finished(now_); });
  }

  // All ask, then all are answered, then some of the rows get through.
  void Turn() {
    now_ += 5000;
    std::vector<Path> asked;
    for (auto& search : searches) {
      for (const Path& path : search->Advance(std::max(0, 2 - search->waiting()), now_)) {
        for (auto& other : searches) {
          if (other != search) {
            other->NoteRequested({path}, now_, search->statistics().writer());
          }
        }
        asked.push_back(path);
      }
    }
    for (const Path& path : asked) {
      for (auto& search : searches) search->Deliver(path, tree_.Evaluate(path), 0);
    }
    for (auto& search : searches) {
      const StatisticsBatch batch = search->MakeBatch(kBatchHeaderBytes + 40, now_);
      for (auto& other : searches) {
        if (std::uniform_real_distribution<double>(0, 1)(random_) >= loss_) {
          other->Merge(batch, now_);
        }
      }
    }
  }

  // Visits of all, as their own tables say.
  std::map<Path, std::int64_t> Truth() const {
    std::map<Path, std::int64_t> truth;
    for (const auto& search : searches) {
      for (const StatisticsRow& row : search->statistics().AllRows()) {
        if (row.writer == search->statistics().writer()) truth[row.path] += row.visits;
      }
      for (PathId id = kRoot; id < search->paths().size(); ++id) {
        const std::int64_t own = search->statistics().own_in_flight(id);
        if (own > 0) truth[search->paths().PathOf(id)] += own;
      }
    }
    return truth;
  }

  std::vector<std::unique_ptr<Search>> searches;

 private:
  double loss_;
  ScriptedTree tree_;
  std::mt19937 random_;
  std::int64_t now_ = 0;
};

std::int64_t Known(const Search& search, const Path& path) {
  const PathTotals& totals = search.statistics().totals(search.paths().Find(path));
  return totals.visits + totals.in_flight + totals.announced;
}

// Rows of most paths never come here, so what is known of them are requests alone.
TEST(Announced, EveryWorkerKnowsOfEveryVisitAtOnce) {
  for (const double loss : {0.0, 0.5}) {
    Crew crew(6, loss, 3);
    for (int turn = 0; turn < 100'000 && !crew.Finished(); ++turn) {
      crew.Turn();
      if (turn % 10 != 0) continue;
      const std::map<Path, std::int64_t> truth = crew.Truth();
      for (const auto& search : crew.searches) {
        for (const auto& [path, visits] : truth) {
          ASSERT_EQ(Known(*search, path), visits) << ToString(path) << " at turn " << turn;
        }
      }
    }
    ASSERT_TRUE(crew.Finished());
  }
}

// How many of `rollouts` went elsewhere in the second level than those of a lone worker.
std::int64_t Elsewhere(const std::map<Path, std::int64_t>& lone,
                       const std::map<Path, std::int64_t>& many) {
  std::int64_t missing = 0;
  for (const auto& [path, visits] : lone) {
    if (path.size() != 2) continue;
    const auto found = many.find(path);
    missing += std::max<std::int64_t>(0, visits - (found == many.end() ? 0 : found->second));
  }
  return missing;
}

// Knowing of all visits, many workers spread their rollouts as one does. (If only rows counted, one
// in twelve would go elsewhere.)
TEST(Announced, ManyWorkersGoWhereOneGoes) {
  std::int64_t elsewhere = 0;
  constexpr int kSeeds = 5;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Crew one(1, 0, seed), many(6, 0.3, seed);
    while (!one.Finished()) one.Turn();
    while (!many.Finished()) many.Turn();
    elsewhere += Elsewhere(one.Truth(), many.Truth());
  }
  EXPECT_LT(elsewhere, kSeeds * Crew::kSamples / 100);
}

}  // namespace
}  // namespace prospect::planner
