// A tree with a known best plan, to measure how good a search's decisions are: 8 actions, each
// allowed any number of times, 6 deep. Every number is a pure function of (seed, path):
//
//   V(root) = 1/2,  V(h a) = V(h) + kStep u(seed, h a),  u uniform in [-1, 1)
//   Q(h, a) = V(h a) + kBlur w(seed, h a),               w uniform in [-1, 1), result kept in [0,
//   1] f = 1, p = 1
//
// so that a plan's score is V at its last node, and siblings' values tell a search where to look,
// without telling it all (kBlur). kStep keeps V in [0.14, 0.86]. The constants are tuned so that
// one worker with the default rule finds the best of the 262,144 plans within 800 rollouts in 60 to
// 90 % of the seeds (prospect bench simulated). Pure; safe from any thread.
#pragma once

#include <cstdint>

#include "planner/model_source.h"
#include "planner/task_rules.h"

namespace prospect::planner {

struct ScriptedTree {
  static constexpr int kBranching = 8;
  static constexpr int kDepth = 6;
  static constexpr double kStep = 0.06;
  static constexpr double kBlur = 0.005;

  std::uint64_t seed = 0;

  // Any action may follow any other; a plan is kDepth long.
  static TaskRules Rules() { return AnyOrder(kBranching, kDepth, /*repeats_allowed=*/true); }

  // V, f, Q, p as above. `path`: at most kDepth actions below kBranching.
  Evaluation Evaluate(const Path& path) const;
  // V of the node, in [0, 1].
  double Value(const Path& path) const;

  struct Optimum {
    double value = 0;  // V at the last node: the best score a plan can have
    Path path;
  };
  // Found by branch and bound over all plans; a few milliseconds.
  Optimum FindOptimum() const;
};

// The tree as a model for RunSearch. Not thread safe.
class ScriptedTreeModel : public ModelSource {
 public:
  explicit ScriptedTreeModel(std::uint64_t seed) : tree_{seed} {}
  Evaluation Evaluate(const Path& path) override { return tree_.Evaluate(path); }

 private:
  ScriptedTree tree_;
};

}  // namespace prospect::planner
