// The parameters of a search, as they stand in SEARCH_ROOT. Plain data.
#pragma once

#include <cstdint>
#include <string>

namespace prospect::planner {

struct SearchParameters {
  std::string rule = "paper";    // planner/selection_rule.h
  double c = 10;                 // exploration constant of the paper's score, > 0
  double c_puct = 1.25;          // exploration constant of PUCT, > 0
  double c_done = 0.1;           // f below it: the action failed, value 0; [0, 1]
  double v_failed = 0.1;         // V below it: this future is not followed further; [0, 1]
  double p_min = 0.01;           // p below it: the action cannot follow; [0, 1]
  double refusal_threshold = 0;  // a best score below it is refused; [0, 1]
  std::int64_t samples = 100;    // rollouts of all workers together, >= 1
  int depth = 32;  // longest path, 1 to kMaxPathLength; the task's remaining length cuts it too
  std::uint64_t seed = 0;  // breaks ties
  std::int64_t deadline_us =
      0;  // no rollout starts from then on, on the caller's steady clock; 0: none
  bool skip_exhausted = false;  // do not walk into futures that are wholly known (the paper does)
  int listed_futures =
      16;  // runners-up and rejected futures listed in a Plan, at most this many each
  std::int64_t patience_us =
      300'000;         // a path that another worker asked for is asked for again after this long
  int collisions = 8;  // rollouts a single Advance gives up because their leaf is already asked for

  // Throws std::invalid_argument naming the field and its range.
  void Validate() const;
};

}  // namespace prospect::planner
