#pragma once

#include <cstdint>
#include <vector>

#include "sim/random.h"
#include "sim/task.h"

namespace prospect::sim {

// Chooses a trial's actions as data sets want them: each uniform among the legal ones, from a
// stream that the trial's seed alone decides. Of tasks that know retries (IsRetry) a
// tenth of the trials takes one: a single one, at the first or a later opportunity; the others take
// none.
//
// Whoever asks the same choices in the same order gets the same plan, in the collector and over the
// bus.
class RandomPlan {
 public:
  // `successors` as TaskSpec's. Without `retries` no trial takes one.
  RandomPlan(std::vector<std::vector<int>> successors, std::uint64_t trial_seed,
             bool retries = true);

  // The next action, of `legal` (not empty, ascending).
  int Choose(const std::vector<int>& legal);

  // Takes note of an action that somebody else chose, so that Choose goes on after it.
  void Follow(int action);

 private:
  std::vector<int> Offered(const std::vector<int>& legal);

  std::vector<std::vector<int>> successors_;
  Random random_;
  int last_;                  // action chosen before
  bool wants_retry_ = false;  // and has not had it
};

}  // namespace prospect::sim
