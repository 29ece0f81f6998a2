// Several searches on a bus that loses, repeats and reorders: what they agree on afterwards, and
// what sharing saves.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <random>

#include "planner/model_source.h"
#include "planner/scripted_model.h"
#include "planner/search.h"

namespace prospect::planner {
namespace {

constexpr std::size_t kBudget = 1400;

struct BusOptions {
  int workers = 2;
  std::int64_t samples = 200;  // of all together
  double loss = 0;       // of evaluations at those who did not ask, of requests and of batches
  double repeat = 0;     // of batches
  bool shuffle = false;  // order of batches
  bool shared = true;    // false: nobody hears anybody
  std::string rule = "paper";
  std::uint64_t seed = 1;
};

class Bus {
 public:
  explicit Bus(const BusOptions& options)
      : options_(options),
        random_(static_cast<unsigned>(options.seed)),
        model_({6, options.seed, 0.2, 0.1, 0.1}) {
    SearchParameters parameters;
    parameters.samples = options.shared ? options.samples : options.samples / options.workers;
    parameters.rule = options.rule;
    parameters.seed = options.seed;
    for (int i = 0; i < options.workers; ++i) {
      const SearchIdentity identity{{7, 1}, 100 + static_cast<std::uint64_t>(i), i, 1'000'000'000};
      searches.push_back(std::make_unique<Search>(AnyOrder(6, 4), parameters, Path{}, identity));
    }
  }

  void Run() {
    for (int step = 0; step < 100'000 && !Finished(); ++step, now_ += 1000) {
      for (auto& search : searches) Turn(search.get());
      DeliverBatches();
    }
    ASSERT_TRUE(Finished());
  }

  // What ends a search: every process's round-robin goes round twice, over a bus that loses
  // nothing, and evaluations that were missed are asked for.
  void Close() {
    for (auto& sender : searches) {
      const std::int64_t rounds = sender->statistics().round_robin_rounds();
      while (sender->statistics().round_robin_rounds() < rounds + 2) {
        const StatisticsBatch batch = sender->MakeBatch(kBudget, now_);
        for (auto& receiver : searches) receiver->Merge(batch, now_);
      }
    }
    for (auto& search : searches) {
      for (const Path& path : search->MissingEvaluations(1 << 20)) {
        search->Deliver(path, model_.Evaluate(path), 0);
      }
    }
  }

  std::int64_t Asked() const {
    std::int64_t sum = 0;
    for (const auto& search : searches) sum += search->evaluations();
    return sum;
  }
  std::int64_t Rollouts() const {
    std::int64_t sum = 0;
    for (const auto& search : searches) sum += search->rollouts();
    return sum;
  }

  std::vector<std::unique_ptr<Search>> searches;

 private:
  bool Finished() const {
    return std::all_of(searches.begin(), searches.end(),
                       [this](const auto& search) { return search->finished(now_); });
  }
  bool Chance(double share) {
    return std::uniform_real_distribution<double>(0, 1)(random_) < share;
  }

  void Turn(Search* search) {
    const std::vector<Path> asked = search->Advance(std::max(0, 2 - search->waiting()), now_);
    for (const Path& path : asked) {
      const Evaluation evaluation = model_.Evaluate(path);
      for (auto& other : searches) {
        const bool own = other.get() == search;
        if (!own && (!options_.shared || Chance(options_.loss))) continue;
        other->Deliver(path, evaluation, 0);
      }
    }
    if (!options_.shared) return;
    const StatisticsBatch batch = search->MakeBatch(kBudget, now_);
    const int copies = 1 + (Chance(options_.repeat) ? 2 : 0);
    for (int i = 0; i < copies; ++i) under_way_.push_back(batch);
  }

  void DeliverBatches() {
    if (options_.shuffle) std::shuffle(under_way_.begin(), under_way_.end(), random_);
    const std::size_t kept = options_.shuffle ? under_way_.size() / 3 : 0;
    while (under_way_.size() > kept) {
      for (auto& search : searches) {
        if (!Chance(options_.loss)) search->Merge(under_way_.front(), now_);
      }
      under_way_.pop_front();
    }
  }

  BusOptions options_;
  std::mt19937 random_;
  ScriptedModel model_;
  std::deque<StatisticsBatch> under_way_;
  std::int64_t now_ = 0;
};

void ExpectAgreement(const Bus& bus) {
  const Search& first = *bus.searches.front();
  const Plan plan = first.BestPlan();
  EXPECT_EQ(first.total_rollouts(), bus.Rollouts());  // nothing lost, nothing counted twice
  for (const auto& search : bus.searches) {
    EXPECT_EQ(search->statistics().digest(), first.statistics().digest());
    EXPECT_EQ(search->statistics().rows(), first.statistics().rows());
    EXPECT_TRUE(search->statistics().ConvergedWithLive());
    EXPECT_EQ(search->statistics().refusals().total(), 0);
    EXPECT_EQ(search->statistics().totals(kRoot).in_flight, 0);
    const Plan other = search->BestPlan();
    EXPECT_EQ(other.status, plan.status);
    EXPECT_EQ(other.best.path, plan.best.path);
    EXPECT_EQ(other.best.score, plan.best.score);
    EXPECT_EQ(other.best.visits, plan.best.visits);
    EXPECT_EQ(other.reason, plan.reason);
    ASSERT_EQ(other.runners_up.size(), plan.runners_up.size());
    for (std::size_t i = 0; i < plan.runners_up.size(); ++i) {
      EXPECT_EQ(other.runners_up[i].path, plan.runners_up[i].path);
    }
  }
}

TEST(Sharing, ExactWithoutLoss) {
  Bus bus({});
  bus.Run();
  bus.Close();
  ExpectAgreement(bus);
}

TEST(Sharing, ExactAfterTheClosingRoundWhateverTheBusDid) {
  for (const std::string& rule : SelectionRuleNames()) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      BusOptions options;
      options.workers = 2 + static_cast<int>(seed % 3);
      options.loss = 0.1 * static_cast<double>(seed);
      options.repeat = 0.3;
      options.shuffle = true;
      options.rule = rule;
      options.seed = seed;
      Bus bus(options);
      bus.Run();
      bus.Close();
      ExpectAgreement(bus);
    }
  }
}

// The same total of rollouts: together they ask for fewer evaluations than apart, and for none
// twice.
TEST(Sharing, SavesEvaluations) {
  double together = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    BusOptions options;
    options.seed = seed;
    Bus shared(options);
    shared.Run();
    shared.Close();
    options.shared = false;
    Bus alone(options);
    alone.Run();
    EXPECT_LE(shared.Asked(), alone.Asked());
    EXPECT_EQ(shared.Asked(), shared.searches[0]->known_evaluations());
    together += static_cast<double>(shared.Asked());
    apart += static_cast<double>(alone.Asked());
  }
  EXPECT_LT(together, 0.8 * apart) << together << " against " << apart;
}

TEST(Sharing, WorkIsSplitAndTheBudgetHardlyOvershot) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    BusOptions options;
    options.workers = 4;
    options.seed = seed;
    Bus bus(options);
    bus.Run();
    for (const auto& search : bus.searches) EXPECT_GT(search->evaluations(), 0);
    EXPECT_LE(bus.Rollouts(), options.samples + 4 * 2);  // workers times leaves
    EXPECT_TRUE(bus.Rollouts() >= options.samples ||
                bus.searches[0]->stop_reason(0) == StopReason::kExhausted);
  }
}

// A worker that died in mid-search holds nobody up, and what it had told stays.
TEST(Sharing, ALateJoinerHearsOfTheDeadThroughOthers) {
  BusOptions options;
  options.workers = 3;
  Bus bus(options);
  bus.Run();
  bus.Close();
  const std::int64_t total = bus.Rollouts();
  Search& survivor = *bus.searches[2];
  Search late(AnyOrder(6, 4), survivor.parameters(), {}, {{7, 1}, 999, 9, 1'000'000});
  const std::int64_t rounds = survivor.statistics().round_robin_rounds();
  while (survivor.statistics().round_robin_rounds() < rounds + 2) {
    late.Merge(survivor.MakeBatch(kBudget, 0), 0);
  }
  EXPECT_EQ(late.total_rollouts(), total);
  EXPECT_EQ(late.statistics().digest(), survivor.statistics().digest());
}

}  // namespace
}  // namespace prospect::planner
