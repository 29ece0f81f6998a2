#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/refusal/conformal.h"
#include "model/refusal/sample.h"

namespace prospect::model {

/// What a user asks of refusals; both, one, or nothing.
struct Promise {
  std::optional<double> refuse_at_most;  ///< alpha: P(refuse | solvable), in (0, 1)
  std::optional<double> fail_at_most;    ///< epsilon: P(fail | attempt), in (0, 1)
  double delta = 0.1;  ///< the second holds with probability 1 - delta over calibration samples

  bool asked() const { return refuse_at_most || fail_at_most; }
};

/// The threshold that a promise leads to.
struct PromisedThreshold {
  double value = 0;  ///< plans that score less are to be refused
  /// False: not even refusing often is known to keep the failures as low as asked: nothing may be
  /// attempted.
  bool may_attempt = true;
  bool kept = true;             ///< all that was asked holds at `value`
  ThresholdBound refuse, fail;  ///< of what was asked
  /// For a person: what holds and why, and what cannot be had together. One sentence each.
  std::vector<std::string> words;
};

/// With one bound the threshold is that bound: the highest that refuses little enough, or the
/// lowest that fails seldom enough. With both it is the first one (of those that keep both, the one
/// that fails least), unless that would break the second: failing costs more than refusing, so the
/// second then holds, and the words say that both cannot be had.
PromisedThreshold ThresholdFor(const CalibrationSample& sample, const Promise& promise);

/// The parameters in which a search differs from those of the calibration, in words ("samples 10
/// instead of 30"); names that only one side knows are left out.
std::vector<std::string> Differences(const CalibrationSample& sample, const std::string& rule,
                                     const std::map<std::string, double>& parameters);

/// A table for a terminal: thresholds from lenient to strict, and what each would have done to the
/// sample. About `rows` lines.
std::string CurveTable(const CalibrationSample& sample, int rows = 12);

/// "5 %", "0.5 %".
std::string PercentText(double share);

}  // namespace prospect::model
