// Whether a search's decision, the first action of its plan, can still change. Proven: no future
// that is still open and begins with another action can score higher, because a plan's score is V
// times f along its path and V is at most 1 (branch and bound: Land and Doig 1960). Stable: no
// proof, but the decision has been the same for a number of rollouts. Not thread safe.
#pragma once

#include <cstdint>

#include "planner/plan_reader.h"

namespace prospect::planner {

struct Decision {
  int first_action = -1;  // of the best complete future that may be carried out; -1: none
  bool proven = false;    // it cannot change any more
};

// Goes over the tree once.
Decision ReadDecision(const PlanSource& source);

class Settlement {
 public:
  // proven: settled when the decision is proven; rollouts: settled when it was seen unchanged over
  // that many rollouts of all workers (0: never).
  Settlement(bool proven, std::int64_t rollouts) : wants_proof_(proven), stable_for_(rollouts) {}

  // Whether it is time to look again: after every eighth more rollouts, so that all looks together
  // cost no more than a few visits to each node.
  bool Due(std::int64_t rollouts) const {
    return (wants_proof_ || stable_for_ > 0) && !settled_ && rollouts >= next_look_;
  }
  // Looks again. `rollouts`: completed so far, by all workers.
  void Update(const PlanSource& source, std::int64_t rollouts);
  bool settled() const { return settled_; }

 private:
  bool wants_proof_;
  std::int64_t stable_for_;
  std::int64_t next_look_ = 1;
  std::int64_t unchanged_since_ = 0;
  int first_action_ = -1;
  bool settled_ = false;
};

}  // namespace prospect::planner
