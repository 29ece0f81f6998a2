#pragma once

#include <cstdint>
#include <vector>

#include "base/random.h"
#include "planner/attempts.h"
#include "planner/task_rules.h"
#include "sim/task.h"

namespace prospect::sim {

// Chooses a trial's actions as data sets want them: each uniform among the legal ones, from a
// stream that the trial's seed alone decides; where the task builds a tower, among those that can
// still lead to one. Of tasks that know retries (IsRetry) a tenth of the trials takes one: a single
// one, at the first or a later opportunity; the others take none.
//
// Whoever asks the same choices in the same order gets the same plan, in the collector and over the
// bus.
class RandomPlan {
 public:
  // `rules` of the task, as PlanRules gives them. Without `retries` no trial takes one.
  RandomPlan(planner::TaskRules rules, std::uint64_t trial_seed, bool retries = true);

  // The next action, of `legal` (not empty, ascending).
  int Choose(const std::vector<int>& legal);

  // Takes note of an action that somebody else chose, so that Choose goes on after it.
  void Follow(int action);

 private:
  bool Retries(int action) const { return IsRetry(rules_.successors, last_, action); }
  void Note(int action);
  std::vector<int> Useful(const std::vector<int>& legal) const;
  std::vector<int> Offered(const std::vector<int>& legal);

  planner::TaskRules rules_;
  base::Random random_;
  int last_;                  // action chosen before
  planner::Attempt attempt_;  // what of those chosen before counts; kept where a tower is built
  bool wants_retry_ = false;  // and has not had it
};

}  // namespace prospect::sim
