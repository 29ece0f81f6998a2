#include "planner/selection_rule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "planner/path.h"

namespace prospect::planner {
namespace {

ParentView Parent(std::int64_t visits, std::int64_t in_flight, double mean, double q_sum) {
  return {visits, in_flight, mean, q_sum};
}

ChildView Child(double q, std::int64_t visits, std::int64_t in_flight, double mean, double best) {
  return {q, visits, in_flight, mean, best, 0, 0};
}

// Of a child that has no siblings.
double Score(const std::string& rule, const ParentView& parent, const ChildView& child) {
  double score = 0;
  MakeSelectionRule(rule, 10, 1.25)->ScoreAll(parent, {&child, 1}, {&score, 1});
  return score;
}

TEST(PaperRule, IsTheFormulaWithTheComingVisitCounted) {
  const ParentView parent = Parent(9, 0, 0.5, 1);
  EXPECT_DOUBLE_EQ(Score("paper", parent, Child(0.4, 0, 0, 0, 0)), 4.0);
  EXPECT_DOUBLE_EQ(Score("paper", parent, Child(0.4, 3, 0, 0.2, 0.7)), 1.7);
  EXPECT_DOUBLE_EQ(Score("paper", parent, Child(0.4, 3, 4, 0.2, 0.7)), 1.2);
}

TEST(PuctRule, CountsVisitsInFlightInTheBonusOnly) {
  const ParentView parent = Parent(12, 4, 0.5, 0.8);
  const double expected = 0.3 + 1.25 * (0.4 / 0.8) * 4 / (1 + 3 + 2);
  EXPECT_DOUBLE_EQ(Score("puct", parent, Child(0.4, 3, 2, 0.3, 0.9)), expected);
  // Unvisited: the parent's mean.
  EXPECT_DOUBLE_EQ(Score("puct", parent, Child(0.4, 0, 0, 0, 0)), 0.5 + 1.25 * 0.5 * 4);
}

TEST(PuctRule, SurvivesQsThatAreAllZero) {
  const double score = Score("puct", Parent(4, 0, 0.5, 0), Child(0, 0, 0, 0, 0));
  EXPECT_TRUE(std::isfinite(score));
}

TEST(BestFirstRule, GoesWhereTheBestOpenFutureLiesAndNotWhereAnotherJustWent) {
  const auto open = [](double value, std::int64_t in_flight) {
    ChildView child = Child(0.9, 5, in_flight, 0.9, 0.9);
    child.open = value;
    return Score("best_first", Parent(9, 0, 0.5, 1), child);
  };
  EXPECT_GT(open(0.5, 0), open(0.4, 0));
  EXPECT_GT(open(0.5, 0), open(0.5, 1));
  EXPECT_GT(open(0.5, 1), open(0.4, 0));
  EXPECT_EQ(open(0, 0), 0);
}

TEST(RandomRule, IsUniformOverChildrenAndRepeatable) {
  std::map<int, int> taken;
  for (int round = 0; round < 3000; ++round) {
    int best = -1;
    double best_score = -1;
    for (int action = 0; action < 3; ++action) {
      ChildView child = Child(0.1 * action, 0, 0, 0, 0);
      child.tie = HashCombine(11, ExtendHash(kRootHash, action));
      const double score = Score("random", Parent(round, 0, 0, 1), child);
      EXPECT_EQ(score, Score("random", Parent(round, 0, 0, 1), child));
      if (score > best_score) best_score = score, best = action;
    }
    ++taken[best];
  }
  for (int action = 0; action < 3; ++action) EXPECT_NEAR(taken[action], 1000, 120);
}

TEST(SelectionRules, NamesAndBackups) {
  EXPECT_EQ(SelectionRuleNames(),
            (std::vector<std::string>{"paper", "puct", "gumbel", "best_first", "random"}));
  for (const std::string& name : SelectionRuleNames()) {
    EXPECT_EQ(MakeSelectionRule(name, 10, 1)->backup(),
              name == "paper" ? Backup::kValueProduct : Backup::kPlanScore);
  }
  try {
    MakeSelectionRule("uct", 10, 1);
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "no selection rule 'uct'; there are: paper puct gumbel best_first random");
  }
}

}  // namespace
}  // namespace prospect::planner
