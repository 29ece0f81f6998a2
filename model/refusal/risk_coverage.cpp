#include "model/refusal/risk_coverage.h"

#include <algorithm>

namespace prospect::model {
namespace {

void Count(const CalibrationScene& scene, ThresholdEffect* effect) {
  if (scene.attempted() && scene.score >= effect->threshold) {
    ++effect->attempted;
    effect->failed += scene.ending == SceneEnding::kFailed;
    effect->solved += scene.ending == SceneEnding::kSolved;
  } else {
    effect->refused_solvable += scene.scene_class == SceneClass::kSolvable;
    effect->refused_hopeless += scene.scene_class == SceneClass::kHopeless;
  }
}

// Scenes without a plan score below all others.
double Rank(const CalibrationScene& scene) { return scene.attempted() ? scene.score : -1; }

}  // namespace

ThresholdEffect EffectOf(const CalibrationSample& sample, double threshold) {
  ThresholdEffect effect;
  effect.threshold = threshold;
  for (const CalibrationScene& scene : sample.scenes) Count(scene, &effect);
  if (!sample.empty())
    effect.coverage = effect.attempted / static_cast<double>(sample.scenes.size());
  if (effect.attempted > 0) effect.risk = effect.failed / static_cast<double>(effect.attempted);
  return effect;
}

std::vector<ThresholdEffect> RiskCoverageCurve(const CalibrationSample& sample) {
  std::vector<double> thresholds;
  for (const CalibrationScene& scene : sample.scenes) {
    if (scene.attempted()) thresholds.push_back(scene.score);
  }
  std::sort(thresholds.rbegin(), thresholds.rend());
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  std::vector<ThresholdEffect> curve;
  for (const double threshold : thresholds) curve.push_back(EffectOf(sample, threshold));
  return curve;
}

double AreaUnder(const std::vector<ThresholdEffect>& curve) {
  if (curve.size() < 2) return 0;
  double area = 0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    area += (curve[i].coverage - curve[i - 1].coverage) * (curve[i].risk + curve[i - 1].risk) / 2;
  }
  return area / (curve.back().coverage - curve.front().coverage);
}

double CoverageAtRisk(const std::vector<ThresholdEffect>& curve, double risk) {
  double coverage = 0;
  for (const ThresholdEffect& effect : curve) {
    if (effect.risk <= risk) coverage = std::max(coverage, effect.coverage);
  }
  return coverage;
}

double SolvabilityAuroc(const CalibrationSample& sample) {
  double won = 0;
  std::int64_t pairs = 0;
  for (const CalibrationScene& solvable : sample.scenes) {
    if (solvable.scene_class != SceneClass::kSolvable) continue;
    for (const CalibrationScene& hopeless : sample.scenes) {
      if (hopeless.scene_class != SceneClass::kHopeless) continue;
      ++pairs;
      if (Rank(solvable) > Rank(hopeless)) won += 1;
      if (Rank(solvable) == Rank(hopeless)) won += 0.5;
    }
  }
  return pairs > 0 ? won / static_cast<double>(pairs) : -1;
}

int CountOf(const CalibrationSample& sample, SceneClass scene_class) {
  return static_cast<int>(
      std::count_if(sample.scenes.begin(), sample.scenes.end(),
                    [&](const auto& scene) { return scene.scene_class == scene_class; }));
}

}  // namespace prospect::model
