// The parameters of a search, as they stand in SEARCH_ROOT. Plain data.
#pragma once

#include <cstdint>
#include <string>

#include "planner/path.h"

namespace prospect::planner {

struct SearchParameters {
  std::string rule = "paper";  // planner/selection_rule.h
  double c = 10;               // exploration constant of the paper's score, > 0
  double c_puct = 1.25;        // exploration constant of PUCT, > 0
  double c_done = 0.1;         // f below it: the action failed, value 0; [0, 1]
  // V below it: this future is not followed further; [0, 1]. The paper has 0.1; V on the way is
  // that of a random continuation, so where two plans of twelve work it falls below that on all of
  // them.
  double v_failed = 0.02;
  double p_min = 0.01;           // p below it: the action cannot follow; [0, 1]
  double refusal_threshold = 0;  // a best score below it is refused; [0, 1]
  // Rollouts of all workers together, >= 1, whatever the sharing: workers that search apart each do
  // their part, samples / workers rounded up.
  std::int64_t samples = 100;
  bool sharing = true;  // rows are merged as they come: one tree. False: a tree for each worker
  int workers = 1;      // that part the samples among them, >= 1; unused where they share
  // Longest path, 1 to kMaxPathLength; the task's remaining length cuts it too.
  int depth = kMaxPathLength;
  std::uint64_t seed = 0;  // breaks ties
  std::int64_t deadline_us =
      0;  // no rollout starts from then on, on the caller's steady clock; 0: none
  int listed_futures =
      16;  // runners-up and rejected futures listed in a Plan, at most this many each
  std::int64_t patience_us =
      300'000;  // a path that another worker asked for is asked for again after this long
  // Rollouts a single Advance gives up because their leaf is asked for already, before it leaves it
  // at that: beyond it, more leaves in flight would only crowd where others look already.
  int collisions = 8;

  // `name` as the rule, with what it takes a failed action and a hopeless future for. A rule that
  // begins where f along the path is highest comes to doubtful futures last, and needs no cut
  // (c_done 0.01, v_failed 0): cuts made for three steps rule most plans of five out. The others
  // keep the defaults above. Cuts that were set to anything else stay as they are.
  void UseRule(const std::string& name);

  // Throws std::invalid_argument naming the field and its range.
  void Validate() const;
};

}  // namespace prospect::planner
