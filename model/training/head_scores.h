#pragma once

#include <vector>

#include "model/training/measures.h"
#include "model/training/scored_split.h"

namespace prospect::model {

/// What V, Q, p and f say about one kind of states, beside what was true.
struct StateJudgements {
  Judgements value;  ///< V against the trial's outcome
  Judgements done;   ///< f against whether the action met its end condition
  Judgements p;      ///< p of every action of the table against MayFollow (samples.h)
  Judgements taken;  ///< p of the action that the trial took next; always true
  Judgements q;      ///< Q of the action that the trial took next against the trial's outcome
};

/// The judgements of one part of the data.
struct HeadJudgements {
  StateJudgements real;       ///< encoded pictures: between actions, and for f also inside them
  StateJudgements imagined;   ///< after any number of transforms
  StateJudgements after_one;  ///< after one
  StateJudgements after_two;
  /// Between actions only, as encoded, and after one and two transforms of such encodings, wherever
  /// in the trial they are.
  StateJudgements boundary, boundary_after_one, boundary_after_two;
  std::vector<Judgements> done_at_depth;  ///< f, [k]: after k+1 transforms
  /// V at the end of the imagined trial times f along it, against the trial's outcome.
  Judgements plan;
};

/// Imagined states, but for boundary_after_*, are those of the whole trial imagined from its first
/// action on. Uses `threads` threads.
HeadJudgements JudgeHeads(const ScoredSplit& split, int threads);

}  // namespace prospect::model
