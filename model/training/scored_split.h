#pragma once

#include <map>
#include <vector>

#include "model/training/context.h"

namespace prospect::model {

/// Trials of one part with fresh encodings of all their frames (by the networks as they are now,
/// not from a cache). Reading is thread-safe.
class ScoredSplit {
 public:
  /// Takes at most `most_trials` trials, evenly spread. Throws DataError if there are none.
  ScoredSplit(const TrainContext& context, Split split, std::size_t most_trials, int threads);

  const TrainContext& context() const { return context_; }
  const std::vector<int>& trials() const { return trials_; }
  /// Encoding of one slot, [1,c,Hh,Wh] on the device.
  torch::Tensor Hidden(int slot) const;

 private:
  const TrainContext& context_;
  std::vector<int> trials_;
  std::map<int, int64_t> row_of_slot_;
  torch::Tensor hidden_;
};

}  // namespace prospect::model
