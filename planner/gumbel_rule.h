// The selection rule of Gumbel AlphaZero (I. Danihelka, A. Guez, J. Schrittwieser, D. Silver,
// Policy improvement by planning with Gumbel, ICLR 2022), for budgets too small to visit everything
// twice.
//
//   root   Each action draws a Gumbel number g, a function of (search seed, action), the same in
//   all
//          workers. The kGumbelActions with the highest g + logit are tried; after each phase of
//          equal visits the better half by g + logit + sigma(q) goes on (sequential halving: Karnin
//          et al. 2013).
//   below  argmax pi'(a) - N(a) / (1 + sum N), where pi' = softmax(logit + sigma(q)): visits follow
//          the improved policy.
//
//   logit = log P, P = Q / sum of Q; q = W / N, the parent's mean where nothing was visited;
//   sigma(q) = (c_visit + max N) c_scale q, c_visit = 50, c_scale = 1
//
// Phases are told by counts alone (N + O of parent and children), so any number of workers that
// share counts go through them together; where counts that are still on their way leave no child
// with exactly the visits that are due, the nearest is taken.
#pragma once

#include <cstdint>
#include <memory>

#include "planner/selection_rule.h"

namespace prospect::planner {

constexpr int kGumbelActions = 16;

// Sequential halving of `samples` visits over `actions`: how many visits the action must have had
// that gets visit number `visit` (0, 1, ...). The schedule goes on past `samples`.
std::int64_t VisitsDue(std::int64_t visit, int actions, std::int64_t samples);

std::unique_ptr<const SelectionRule> MakeGumbelRule();

}  // namespace prospect::planner
