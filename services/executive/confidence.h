#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/refusal/promise.h"
#include "model/refusal/risk_coverage.h"
#include "model/refusal/sample.h"

namespace prospect::services {

// What calibration scenes say of a score, for people. Plain data and pure functions; the sample
// comes with the weights (CALIBRATION).

/// How likely the plan at hand is to succeed, as counted on calibration scenes of like score.
struct Confidence {
  int scenes = 0;            ///< of like score; 0: nothing is known
  int solved = 0;            ///< of those
  double low = 0, high = 0;  ///< their scores
  double share() const { return scenes > 0 ? static_cast<double>(solved) / scenes : 0; }

  int sample = 0;                     ///< all scenes of the calibration
  std::vector<std::string> promises;  ///< what was promised for, and with what threshold
  std::string caveat;                 ///< why this search is not covered; empty: it is
  std::string table;  ///< thresholds and what each leads to, where a promise cannot be kept
  std::vector<model::ThresholdEffect> curve;  ///< of the sample, strictest first
};

/// @param parameters of the search, by the names of the calibration; what only one side names is
/// not compared
/// @param goal whether a goal beyond the task's own was given: calibration scenes had none
Confidence ConfidenceOf(const model::CalibrationSample& sample, double score,
                        const std::string& rule, const std::map<std::string, double>& parameters,
                        bool goal);

/// "Succeeds in about 86 %: of 57 calibration scenes whose plan scored 0.931 to 0.967, 49 were
/// solved." Empty where nothing is known.
/// @param act false: the plan is refused, so what it would do is told
std::string SuccessSentence(const Confidence& confidence, bool act = true);

/// Risk against coverage as an SVG element, with the threshold's place on it; empty for a curve of
/// fewer than two points.
std::string RiskChart(const Confidence& confidence, double threshold);

}  // namespace prospect::services
