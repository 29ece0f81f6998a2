#pragma once

#include <cstdint>
#include <vector>

#include "model/refusal/binomial.h"
#include "model/refusal/promise.h"

namespace prospect::tools {

/// A threshold from one half of the scenes, and what it does to the other half.
struct SplitOutcome {
  bool kept = false;     ///< the calibration half promises it at some threshold
  double threshold = 0;  ///< 0 where none is kept
  int count = 0;         ///< refused of the test half's solvable ones, or failed of its attempts
  int total = 0;
  model::CountBand band;  ///< 95 % of all test halves of this size show a count in it
  double rate() const { return total > 0 ? static_cast<double>(count) / total : 0; }
  bool within() const { return band.Holds(count); }
};

/// How a promise fared over random halves.
struct SplitSummary {
  double target = 0;
  std::vector<SplitOutcome> splits;
  int kept = 0;
  int within = 0;             ///< of those kept
  double mean = 0;            ///< rate over those kept
  double standard_error = 0;  ///< of the mean, splits taken as independent
};

/// One random half of a sample (the larger where it is odd) to calibrate on, and the other to test.
struct Halves {
  model::CalibrationSample calibration, test;
};
Halves SplitInHalves(const model::CalibrationSample& sample, std::uint64_t seed);

/// alpha of RefuseAtMost against the share of the test half's solvable scenes that is refused. With
/// n solvable calibration scenes and k = floor(alpha (n + 1)) the count is beta-binomial with k and
/// n + 1 - k, exactly where no two scores are equal.
SplitOutcome TestRefuseAtMost(const Halves& halves, double alpha);

/// epsilon of FailAtMost against the share of the test half's attempts that fails. The promise is
/// an upper bound, so the band reaches from 0 to what a share of just epsilon may show.
SplitOutcome TestFailAtMost(const Halves& halves, double epsilon, double delta);

/// `splits` random splits: random halves with seeds from `seed` on, each of which serves twice,
/// with one half to calibrate on and then with the other, so that every scene counts as often in
/// the calibrations as in the tests (as in repeated two-fold cross-validation). Fewer once the
/// program is to stop (base/stop_signals.h).
SplitSummary RunRefuseSplits(const model::CalibrationSample& sample, double alpha, int splits,
                             std::uint64_t seed);
SplitSummary RunFailSplits(const model::CalibrationSample& sample, double epsilon, double delta,
                           int splits, std::uint64_t seed);

}  // namespace prospect::tools
