#pragma once

#include <vector>

#include "model/training/measures.h"
#include "model/training/scored_split.h"

namespace prospect::model {

/// What V, Q, p and f say about the states of one part of the data, beside what was true.
struct HeadJudgements {
  Judgements value_real, value_imagined, value_after_two;
  Judgements done_real, done_imagined;
  std::vector<Judgements> done_at_depth;  ///< [k]: after k+1 transforms
  Judgements p_real, p_imagined, q_real, q_imagined;
  Judgements
      plan;  ///< V at the end of the imagined trial times f along it, against the trial's outcome
};

/// Imagined states are those of the whole trial imagined from its first action on. Uses `threads`
/// threads.
HeadJudgements JudgeHeads(const ScoredSplit& split, int threads);

}  // namespace prospect::model
