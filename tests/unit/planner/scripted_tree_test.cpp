#include "planner/scripted_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/search.h"

namespace prospect::planner {
namespace {

TEST(ScriptedTree, IsAPureFunctionOfSeedAndPath) {
  const ScriptedTree tree{3}, same{3}, other{4};
  const Path path{1, 7, 0, 3};
  EXPECT_EQ(tree.Evaluate(path).value, same.Evaluate(path).value);
  EXPECT_EQ(tree.Evaluate(path).q, same.Evaluate(path).q);
  EXPECT_NE(tree.Evaluate(path).value, other.Evaluate(path).value);
  EXPECT_EQ(tree.Value({}), 0.5);
}

TEST(ScriptedTree, AChildsValueIsItsParentsPlusABoundedStep) {
  const ScriptedTree tree{5};
  Path path;
  for (int depth = 0; depth < ScriptedTree::kDepth; ++depth) {
    const double above = tree.Value(path);
    const Evaluation at = tree.Evaluate(path);
    EXPECT_EQ(*Defect(at, ScriptedTree::kBranching), '\0');
    for (std::uint8_t a = 0; a < ScriptedTree::kBranching; ++a) {
      Path below = path;
      below.push_back(a);
      EXPECT_LE(std::abs(tree.Value(below) - above), ScriptedTree::kStep);
      EXPECT_NEAR(at.q[a], tree.Value(below), ScriptedTree::kBlur + 1e-6);
    }
    path.push_back(static_cast<std::uint8_t>(depth));
  }
}

// The optimum of branch and bound against every plan there is.
TEST(ScriptedTree, TheOptimumIsTheBestOfAllPlans) {
  const ScriptedTree tree{8};
  double best = 0;
  for (int n = 0; n < 1 << (3 * ScriptedTree::kDepth); ++n) {
    Path path;
    for (int d = 0; d < ScriptedTree::kDepth; ++d) path.push_back((n >> (3 * d)) & 7);
    best = std::max(best, tree.Value(path));
  }
  EXPECT_EQ(tree.FindOptimum().value, best);
  EXPECT_EQ(tree.Value(tree.FindOptimum().path), best);
}

// The tree's numbers are part of what benchmarks compare over time: they must not drift.
TEST(ScriptedTree, NumbersAsEver) {
  const ScriptedTree tree{1};
  EXPECT_NEAR(tree.Value({0, 1, 2, 3, 4, 5}), 0.463814530034939, 1e-12);
}

// Hard enough that a search must look for it, and easy enough that it finds it: 60 to 90 %.
TEST(ScriptedTree, OneWorkerUsuallyFindsTheOptimum) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    ScriptedTreeModel model(seed);
    SearchParameters parameters;
    parameters.samples = 800;
    Search search(ScriptedTree::Rules(), parameters, {}, {});
    RunSearch(&search, &model);
    found += search.BestPlan().best.path == ScriptedTree{seed}.FindOptimum().path ? 1 : 0;
  }
  EXPECT_GE(found, 36);
  EXPECT_LE(found, 54);
}

}  // namespace
}  // namespace prospect::planner
