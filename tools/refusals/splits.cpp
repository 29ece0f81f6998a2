#include "tools/refusals/splits.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "base/stop_signals.h"
#include "model/refusal/risk_coverage.h"

namespace prospect::tools {
namespace {

constexpr double kLevel = 0.95;

void SortByScore(model::CalibrationSample* sample) {
  std::stable_sort(sample->scenes.begin(), sample->scenes.end(),
                   [](const auto& a, const auto& b) { return a.score < b.score; });
}

SplitSummary Summary(double target, std::vector<SplitOutcome> splits) {
  SplitSummary summary;
  summary.target = target;
  double sum = 0, squares = 0;
  for (const SplitOutcome& split : splits) {
    if (!split.kept) continue;
    ++summary.kept;
    summary.within += split.within();
    sum += split.rate();
    squares += split.rate() * split.rate();
  }
  summary.splits = std::move(splits);
  const double n = summary.kept;
  if (n > 0) summary.mean = sum / n;
  if (n > 1) {
    const double variance = std::max(0.0, (squares - n * summary.mean * summary.mean) / (n - 1));
    summary.standard_error = std::sqrt(variance / n);
  }
  return summary;
}

SplitSummary Run(const model::CalibrationSample& sample, double target, int splits,
                 std::uint64_t seed, const std::function<SplitOutcome(const Halves&)>& test) {
  std::vector<SplitOutcome> outcomes;
  for (int i = 0; i < splits && !base::StopRequested(); ++i) {
    Halves halves = SplitInHalves(sample, seed + static_cast<std::uint64_t>(i / 2));
    if (i % 2 == 1) std::swap(halves.calibration, halves.test);
    outcomes.push_back(test(halves));
  }
  return Summary(target, std::move(outcomes));
}

}  // namespace

Halves SplitInHalves(const model::CalibrationSample& sample, std::uint64_t seed) {
  std::vector<model::CalibrationScene> scenes = sample.scenes;
  std::mt19937_64 random(seed);
  // Fisher and Yates's shuffle by hand: the library's differs from one to the next.
  for (std::size_t i = scenes.size(); i > 1; --i) std::swap(scenes[i - 1], scenes[random() % i]);
  const auto middle =
      scenes.begin() + static_cast<std::ptrdiff_t>(scenes.size() - scenes.size() / 2);
  Halves halves;
  halves.calibration.scenes.assign(scenes.begin(), middle);
  halves.test.scenes.assign(middle, scenes.end());
  SortByScore(&halves.calibration);
  SortByScore(&halves.test);
  return halves;
}

SplitOutcome TestRefuseAtMost(const Halves& halves, double alpha) {
  const model::ThresholdBound bound = model::RefuseAtMost(halves.calibration, alpha);
  SplitOutcome outcome;
  outcome.kept = bound.kept;
  outcome.threshold = bound.value;
  outcome.count = model::EffectOf(halves.test, bound.value).refused_solvable;
  outcome.total = model::CountOf(halves.test, model::SceneClass::kSolvable);
  if (!bound.kept) return outcome;
  const double k = std::floor(alpha * (bound.scenes + 1.0) + 1e-9);
  outcome.band = model::BetaBinomialBand(outcome.total, k, bound.scenes + 1 - k, kLevel);
  return outcome;
}

SplitOutcome TestFailAtMost(const Halves& halves, double epsilon, double delta) {
  const model::ThresholdBound bound = model::FailAtMost(halves.calibration, epsilon, delta);
  SplitOutcome outcome;
  outcome.kept = bound.kept;
  if (!bound.kept) return outcome;
  const model::ThresholdEffect effect = model::EffectOf(halves.test, bound.value);
  outcome.threshold = bound.value;
  outcome.count = effect.failed;
  outcome.total = effect.attempted;
  outcome.band = model::BinomialBandFromZero(outcome.total, epsilon, kLevel);
  return outcome;
}

SplitSummary RunRefuseSplits(const model::CalibrationSample& sample, double alpha, int splits,
                             std::uint64_t seed) {
  return Run(sample, alpha, splits, seed,
             [&](const Halves& halves) { return TestRefuseAtMost(halves, alpha); });
}

SplitSummary RunFailSplits(const model::CalibrationSample& sample, double epsilon, double delta,
                           int splits, std::uint64_t seed) {
  return Run(sample, epsilon, splits, seed,
             [&](const Halves& halves) { return TestFailAtMost(halves, epsilon, delta); });
}

}  // namespace prospect::tools
