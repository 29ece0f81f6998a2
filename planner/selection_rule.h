// Which child a rollout goes to next, and how values travel up. A rule sees numbers only; the
// search applies the task's rules and the structure prior before it asks, and breaks ties by
// hash(search seed, worker index, path). Rules are immutable and safe from any thread.
//
// Names for MakeSelectionRule:
//   paper   c Q / (N + O + 1) + v*, v* = 0 if unvisited. Paper, Algorithm 1 (SAMPLE), with the
//   visit
//           about to be made counted in N (the paper's formula is undefined at N = 0) and visits in
//           flight O beside it. Backs up the product of V.
//   puct    W/N + c_puct P sqrt(N_parent + O_parent) / (1 + N + O), where P = Q / sum of Q over the
//           children (Silver et al. 2017). Visits in flight enter the bonus only, as in WU-UCT (Liu
//           et al. 2020) and lc0. An unvisited child's mean is its parent's. Backs up the plan
//           score.
//   gumbel  For small budgets: sequential halving over Gumbel-Top-k actions at the root,
//           planner/gumbel_rule.h (Danihelka et al. 2022). Backs up the plan score.
//   best_first  The child below which the most promising open future lies (ChildView::open): a
//           rollout begins at the best node that nobody has looked at yet, anywhere in the tree,
//           and follows it to its end. Best-first search, whose rollouts never repeat each other.
//           Backs up the plan score.
//   random  Uniform over the children, a function of seed, worker, path and visits. Backs up the
//           plan score.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace prospect::planner {

// How a rollout's value is formed on the way up. The first node counted is the root.
enum class Backup {
  kValueProduct,  // v = V times the value below (paper, Algorithm 1); at the last node v = V
  kPlanScore,     // v = f times the value below; at the last node v = f V (f = 1 at the root)
};

// The node whose children are compared. Counts are sums over all writers.
struct ParentView {
  std::int64_t visits;     // completed visits N
  std::int64_t in_flight;  // live visits O
  double mean;             // W / N, or V if unvisited
  double q_sum;            // sum of Q over the children that may be chosen
  bool root = false;
  std::int64_t samples = 0;  // rollouts this search is given in all
};

struct ChildView {
  double q;                // Q of the action
  std::int64_t visits;     // N
  std::int64_t in_flight;  // O
  double mean;             // W / N; 0 if unvisited
  double best;             // v*; 0 if unvisited
  double open;             // the best of what nobody has looked at below it: f along the path
                           // times Q of what comes next; 0: nothing, or the rule does not ask
  std::uint64_t tie;       // hash(seed, worker, path), constant for a child
  std::uint64_t draw = 0;  // hash(seed, path): the same for all workers
};

class SelectionRule {
 public:
  virtual ~SelectionRule() = default;
  // One score for each of the children, which are all that may be chosen, into as many `scores`.
  // The child with the highest score is taken. Never NaN; +infinity is allowed.
  virtual void ScoreAll(const ParentView& parent, std::span<const ChildView> children,
                        std::span<double> scores) const = 0;
  virtual Backup backup() const = 0;
  // Whether ChildView::open is to be kept.
  virtual bool asks_for_open() const { return false; }
};

// The action's share of Q among its siblings; all alike where Q gives no hint.
inline double Prior(const ParentView& parent, const ChildView& child) {
  return parent.q_sum > 0 ? child.q / parent.q_sum : 1.0;
}

// c: the paper's exploration constant; c_puct: PUCT's. Throws std::invalid_argument listing the
// names for an unknown one.
std::unique_ptr<const SelectionRule> MakeSelectionRule(std::string_view name, double c,
                                                       double c_puct);

// The names above, in that order: what --rule takes.
std::vector<std::string> SelectionRuleNames();

}  // namespace prospect::planner
