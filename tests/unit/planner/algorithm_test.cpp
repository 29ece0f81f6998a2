// Algorithm 1 of the paper: step by step on a tree worked out by hand, against a plain recursive
// transcription of the pseudo-code on many scripted trees, and against one whole tree written down.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "planner/model_source.h"
#include "planner/scripted_model.h"
#include "planner/search.h"
#include "tests/unit/planner/table_model.h"

namespace prospect::planner {
namespace {

SearchParameters Parameters(const std::string& rule, int samples) {
  SearchParameters parameters;
  parameters.v_failed = 0.1;  // the paper's
  parameters.rule = rule;
  parameters.samples = samples;
  return parameters;
}

PathTotals TotalsAt(const Search& search, const Path& path) {
  return search.statistics().totals(search.paths().Find(path));
}

double Sum(const PathTotals& totals) {
  return static_cast<double>(totals.value_sum) / static_cast<double>(kValueOne);
}

// Q = 0.4, 0.2 at the root and c = 10: scores 4 and 2, so action 0 goes first, then 1: v(0-1) = V =
// 0.5, v(0) = 0.8 * 0.5 = 0.4, v(root) = 0.5 * 0.4 = 0.2.
TEST(Algorithm1, FirstRolloutByHand) {
  TableModel model = TwoActionModel();
  Search search(AnyOrder(2, 2), Parameters("paper", 1), {}, {});
  RunSearch(&search, &model);
  EXPECT_EQ(model.asked, (std::vector<Path>{{}, {0}, {0, 1}}));
  EXPECT_NEAR(TotalsAt(search, {0, 1}).best, 0.5, 1e-6);
  EXPECT_NEAR(TotalsAt(search, {0}).best, 0.4, 1e-6);
  EXPECT_NEAR(TotalsAt(search, {}).best, 0.2, 1e-6);
  EXPECT_EQ(TotalsAt(search, {1}).visits, 0);
  EXPECT_EQ(search.stop_reason(0), StopReason::kSamples);
}

// Second rollout: 4/2 + 0.4 = 2.4 against 2: action 0 again. Third: 4/3 + 0.4 = 1.73 against 2:
// action 1, and v(1-0) = 0.9, v(1) = 0.6 * 0.9 = 0.54, v(root) = 0.27. Then everything is known.
TEST(Algorithm1, ThreeRolloutsByHand) {
  TableModel model = TwoActionModel();
  Search search(AnyOrder(2, 2), Parameters("paper", 100), {}, {});
  RunSearch(&search, &model);
  EXPECT_EQ(search.stop_reason(0), StopReason::kExhausted);
  EXPECT_EQ(model.asked, (std::vector<Path>{{}, {0}, {0, 1}, {1}, {1, 0}}));
  EXPECT_EQ(TotalsAt(search, {}).visits, 3);
  EXPECT_EQ(TotalsAt(search, {0}).visits, 2);
  EXPECT_EQ(TotalsAt(search, {1}).visits, 1);
  EXPECT_NEAR(Sum(TotalsAt(search, {})), 0.2 + 0.2 + 0.27, 1e-6);
  EXPECT_NEAR(TotalsAt(search, {1}).best, 0.54, 1e-6);
  EXPECT_EQ(search.rollouts(), 3);
  EXPECT_EQ(search.evaluations(), 5);
}

TEST(Algorithm1, PlanScoreBackupByHand) {
  TableModel model = TwoActionModel();
  Search search(AnyOrder(2, 2), Parameters("puct", 100), {}, {});
  RunSearch(&search, &model);
  EXPECT_NEAR(TotalsAt(search, {0, 1}).best, 0.5 * 0.5, 1e-6);
  EXPECT_NEAR(TotalsAt(search, {0}).best, 0.9 * 0.5 * 0.5, 1e-6);
  EXPECT_NEAR(TotalsAt(search, {}).best, 0.8 * 0.9 * 0.9, 1e-6);
}

TEST(Algorithm1, FailedActionGivesZeroAndEndsTheRollout) {
  TableModel model = TwoActionModel();
  model.At({0}).done = 0.09f;
  Search search(AnyOrder(2, 2), Parameters("paper", 1), {}, {});
  RunSearch(&search, &model);
  EXPECT_EQ(model.asked, (std::vector<Path>{{}, {0}}));
  EXPECT_EQ(TotalsAt(search, {0}).visits, 1);
  EXPECT_EQ(TotalsAt(search, {0}).best, 0);
}

TEST(Algorithm1, LowValueEndsTheRolloutWithThatValue) {
  TableModel model = TwoActionModel();
  model.At({0}).value = 0.05f;
  Search search(AnyOrder(2, 2), Parameters("paper", 1), {}, {});
  RunSearch(&search, &model);
  EXPECT_EQ(model.asked, (std::vector<Path>{{}, {0}}));
  EXPECT_NEAR(TotalsAt(search, {0}).best, 0.05, 1e-6);
}

TEST(Algorithm1, TheRootIsNeverTested) {
  TableModel model = TwoActionModel();
  model.At({}).value = 0.01f;
  model.At({}).done = 0.0f;
  Search search(AnyOrder(2, 2), Parameters("paper", 50), {}, {});
  RunSearch(&search, &model);
  EXPECT_EQ(model.asked.size(), 5u);
  EXPECT_TRUE(search.BestPlan().ok());
}

TEST(Algorithm1, PriorRejectsAndADeadEndGivesZero) {
  TableModel model = TwoActionModel();
  model.At({}).p = {1.0f, 0.009f};
  model.At({0}).p = {1.0f, 0.0f};
  Search search(AnyOrder(2, 2), Parameters("paper", 20), {}, {});
  RunSearch(&search, &model);
  EXPECT_EQ(model.asked, (std::vector<Path>{{}, {0}}));
  EXPECT_EQ(TotalsAt(search, {0}).best, 0);
  EXPECT_EQ(TotalsAt(search, {0}).visits, 1);
  EXPECT_EQ(search.stop_reason(0), StopReason::kExhausted);
}

TEST(Algorithm1, DepthLimitEndsWithV) {
  TableModel model = TwoActionModel();
  SearchParameters parameters = Parameters("paper", 10);
  parameters.depth = 1;
  Search search(AnyOrder(2, 2), parameters, {}, {});
  RunSearch(&search, &model);
  EXPECT_EQ(model.asked, (std::vector<Path>{{}, {0}, {1}}));
  EXPECT_NEAR(TotalsAt(search, {0}).best, 0.8, 1e-6);
}

// --- against a transcription of the pseudo-code

class Reference {
 public:
  struct Edge {
    std::int64_t visits = 0;
    double best = 0;
  };

  Reference(const TaskRules& rules, const SearchParameters& parameters, ModelSource* model)
      : rules_(rules), parameters_(parameters), model_(model) {}

  double Explore(const Path& path) {
    const Evaluation e = AsOnTheWire(model_->Evaluate(path));
    double result = 0;
    if (!Ends(path, e, &result)) {
      const int action = Sample(path, e);
      if (action >= 0) {
        Path next = path;
        next.push_back(static_cast<std::uint8_t>(action));
        result = Explore(next) * static_cast<double>(e.value);
      }
    }
    Edge& edge = edges[path];
    ++edge.visits;
    edge.best = std::max(edge.best, std::floor(result * kValueOne + 0.5) / kValueOne);
    return result;
  }

  std::map<Path, Edge> edges;

 private:
  bool Ends(const Path& path, const Evaluation& e, double* result) const {
    *result = e.value;
    if (!path.empty() && e.done < parameters_.c_done) {
      *result = 0;
      return true;
    }
    if (!path.empty() && e.value < parameters_.v_failed) return true;
    const bool ends =
        static_cast<int>(path.size()) >= parameters_.depth || rules_.Complete({}, path);
    if (!ends) *result = 0;
    return ends;
  }

  int Sample(const Path& path, const Evaluation& e) {
    const std::uint64_t seed = HashCombine(parameters_.seed, 0);
    std::tuple<double, std::uint64_t, int> best{-1, 0, -1};
    for (const int action : rules_.AllowedActions({}, path)) {
      if (e.p[action] < parameters_.p_min) continue;
      Path next = path;
      next.push_back(static_cast<std::uint8_t>(action));
      const Edge edge = edges[next];
      const double score =
          parameters_.c * static_cast<double>(e.q[action]) / static_cast<double>(edge.visits + 1) +
          edge.best;
      best = std::max(best, std::make_tuple(score, HashCombine(seed, HashPath(next)), action));
    }
    return std::get<2>(best);
  }

  const TaskRules& rules_;
  const SearchParameters& parameters_;
  ModelSource* model_;
};

void ExpectSameTree(const Search& search, const Reference& reference) {
  std::size_t visited = 0;
  for (const auto& [path, edge] : reference.edges) {
    if (edge.visits == 0) continue;
    ++visited;
    ASSERT_EQ(TotalsAt(search, path).visits, edge.visits) << ToString(path);
    ASSERT_EQ(TotalsAt(search, path).best, static_cast<float>(edge.best)) << ToString(path);
  }
  ASSERT_EQ(static_cast<std::size_t>(search.statistics().rows()), visited);
}

TEST(Algorithm1, EqualsTheRecursiveTranscriptionOnManyTrees) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const TaskRules rules = AnyOrder(6, 4, seed % 2 == 1);
    SearchParameters parameters = Parameters("paper", 150);
    parameters.seed = seed;
    if (seed % 3 == 0) parameters.depth = 3;
    ScriptedModelParameters scripted;
    scripted.num_actions = 6;
    scripted.seed = seed;
    ScriptedModel model(scripted);
    Search search(rules, parameters, {}, {});
    RunSearch(&search, &model);
    EXPECT_EQ(model.evaluations(), search.evaluations());
    ScriptedModel again(scripted);
    Reference reference(rules, parameters, &again);
    for (int i = 0; i < search.rollouts(); ++i) reference.Explore({});
    ExpectSameTree(search, reference);
  }
}

// --- one whole tree

std::string Written(const Search& search) {
  std::ostringstream text;
  text.precision(6);
  text << std::fixed;
  for (const StatisticsRow& row : search.statistics().AllRows()) {
    text << ToString(row.path) << " " << row.visits << " " << row.best << "\n";
  }
  return text.str();
}

TEST(Algorithm1, GoldenTree) {
  ScriptedModelParameters scripted;
  scripted.num_actions = 3;
  scripted.seed = 1;
  ScriptedModel model(scripted);
  SearchParameters parameters = Parameters("paper", 12);
  Search search(AnyOrder(3, 3), parameters, {}, {});
  RunSearch(&search, &model);
  EXPECT_EQ(Written(search), R"(root 12 0.168482
0 4 0.043049
0-1 2 0.086876
0-2 2 0.000000
0-2-1 2 0.000000
1 7 0.243090
1-0 3 0.343523
1-0-2 3 0.698207
1-2 4 0.000000
1-2-0 4 0.000000
2 1 0.045691
)");
}

}  // namespace
}  // namespace prospect::planner
