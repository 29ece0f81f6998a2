#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/refusal/promise.h"
#include "model/refusal/risk_coverage.h"
#include "model/refusal/sample.h"

namespace prospect::agent {

// What calibration scenes say of a score, for people. Plain data and pure functions; the sample
// comes with the weights (CALIBRATION).

/// How likely a plan that is to be carried out is to succeed, as counted on calibration scenes of
/// like score.
struct Confidence {
  int scenes = 0;            ///< of like score, and attempted at the threshold at hand
  int solved = 0;            ///< of those
  double low = 0, high = 0;  ///< their scores
  double share() const { return scenes > 0 ? static_cast<double>(solved) / scenes : 0; }
};

/// By what plans are refused, as far as the calibration tells.
struct RefusalTerms {
  int sample = 0;                     ///< all scenes of the calibration
  std::vector<std::string> promises;  ///< what was promised for, and with what threshold
  std::string caveat;                 ///< why this search is not covered; empty: it is
  std::string table;  ///< thresholds and what each leads to, where a promise cannot be kept
  std::vector<model::ThresholdEffect> curve;  ///< of the sample, strictest first
};

/// Nothing where the score lies outside those of the scenes that are attempted at this threshold:
/// nobody has counted there.
std::optional<Confidence> ConfidenceOf(const model::CalibrationSample& sample, double score,
                                       double threshold);

/// Without promises and table.
/// @param parameters of the search, by the names of the calibration; what only one side names is
/// not compared
/// @param goal whether a goal beyond the task's own was given: calibration scenes had none
RefusalTerms TermsOf(const model::CalibrationSample& sample, const std::string& rule,
                     const std::map<std::string, double>& parameters, bool goal);

/// "Succeeds in about 86 %: of 57 calibration scenes whose plan scored 0.931 to 0.967, 49 were
/// solved."
std::string SuccessSentence(const Confidence& confidence);

/// For people: how likely the plan is to succeed, if there is one to be carried out, what was
/// promised, and what neither of them covers.
std::vector<std::string> ConfidenceSentences(const std::optional<Confidence>& confidence,
                                             const std::optional<RefusalTerms>& terms);

}  // namespace prospect::agent
