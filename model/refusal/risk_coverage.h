#pragma once

#include <vector>

#include "model/refusal/sample.h"

namespace prospect::model {

/// What a threshold would have done to a sample.
struct ThresholdEffect {
  double threshold = 0;
  int attempted = 0;  ///< of all scenes
  int failed = 0;     ///< of those attempted
  int solved = 0;     ///< of those attempted
  int refused_solvable = 0;
  int refused_hopeless = 0;
  double coverage = 0;  ///< attempted share of all scenes
  double risk = 0;      ///< failed share of those attempted; 0 where nothing is
};
ThresholdEffect EffectOf(const CalibrationSample& sample, double threshold);

/// The effect of every score as threshold, strictest first: the risk-coverage curve (El-Yaniv and
/// Wiener 2010).
std::vector<ThresholdEffect> RiskCoverageCurve(const CalibrationSample& sample);

/// The mean risk over the coverages of the curve, from its first point to its last, by the
/// trapezoid rule. 0 for a curve of fewer than two points.
double AreaUnder(const std::vector<ThresholdEffect>& curve);

/// The largest coverage whose risk is at most `risk`; 0: none.
double CoverageAtRisk(const std::vector<ThresholdEffect>& curve, double risk);

/// How well the score tells solvable from hopeless scenes: the probability that a solvable one
/// scores more than a hopeless one, ties counted half; scenes without a plan score least. -1 where
/// either class is missing.
double SolvabilityAuroc(const CalibrationSample& sample);

/// How many scenes are of a class.
int CountOf(const CalibrationSample& sample, SceneClass scene_class);

}  // namespace prospect::model
