#pragma once

#include "model/refusal/sample.h"

namespace prospect::model {

/// A bound on the refusal threshold, and what it was taken from.
struct ThresholdBound {
  bool kept = false;  ///< false: this sample cannot promise it at any threshold
  double value = 0;   ///< the bound; 0 where none is kept
  int scenes = 0;     ///< solvable ones, or attempted ones at or above the bound
  int count = 0;      ///< of those: refused at the bound, or failed
};

/// "Do not refuse what can be done": the highest threshold with P(refuse | solvable) <= alpha, by
/// class-conditional split conformal prediction (Vovk 2012).
/// Of the solvable scenes' scores, those without a plan lowest, it is the k-th smallest with
/// k = floor(alpha (n + 1)): a new solvable scene scores below it with probability at most
/// k / (n + 1). Not kept where k is 0 (too few scenes), or where the k-th has no plan at all.
/// `count` is the number of the n that the threshold refuses.
/// @param alpha in (0, 1)
ThresholdBound RefuseAtMost(const CalibrationSample& sample, double alpha);

/// "Do not fail what you attempt": the lowest threshold with P(fail | attempt) <= epsilon, by learn
/// then test (Angelopoulos et al. 2021): thresholds are tested by the exact binomial p-value of
/// "the share that fails is above epsilon", in two sequences of fixed order at level delta / 2
/// each. One goes from strict to lenient by number of scenes attempted, from FirstTested on, until
/// a test is not passed; the other is the one test of attempting all, for scores that do not rank
/// what may go wrong. The most lenient threshold that passed is taken: with probability 1 - delta
/// over the sample the share is at most epsilon, as long as it does not rise with the score.
/// Stopped episodes are attempts and no failures. Not kept where no test is passed.
/// @param epsilon, delta in (0, 1)
ThresholdBound FailAtMost(const CalibrationSample& sample, double epsilon, double delta);

/// Attempts in the first test of the first sequence, which has level `delta`: enough for a planner
/// that fails at a quarter of epsilon to pass it nine times of ten, but at most half of all
/// `attempts` unless fewer could not pass without a failure. A function of the numbers alone, so
/// that it does not look at what it tests.
int FirstTested(int attempts, double epsilon, double delta);

}  // namespace prospect::model
