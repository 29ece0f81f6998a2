#include "model/refusal/conformal.h"

#include <algorithm>
#include <cmath>

#include "model/refusal/binomial.h"

namespace prospect::model {
namespace {

constexpr double kWantedPower = 0.9;
constexpr int kMostTested = 100000;
constexpr double kNoPlan = -1;  // below every score

std::vector<double> SolvableScores(const CalibrationSample& sample) {
  std::vector<double> scores;
  for (const CalibrationScene& scene : sample.scenes) {
    if (scene.scene_class == SceneClass::kSolvable)
      scores.push_back(scene.attempted() ? scene.score : kNoPlan);
  }
  std::sort(scores.begin(), scores.end());
  return scores;
}

// Highest score first.
std::vector<CalibrationScene> Attempts(const CalibrationSample& sample) {
  std::vector<CalibrationScene> attempts;
  for (const CalibrationScene& scene : sample.scenes) {
    if (scene.attempted()) attempts.push_back(scene);
  }
  std::stable_sort(attempts.begin(), attempts.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  return attempts;
}

// The most failures of n at which the test is passed; -1: none.
int MostFailures(int n, double epsilon, double delta) {
  int k = -1;
  while (BinomialAtMost(k + 1, n, epsilon) <= delta) ++k;
  return k;
}

int FewestThatCanPass(double epsilon, double delta) {
  return static_cast<int>(std::ceil(std::log(delta) / std::log1p(-epsilon) - 1e-9));
}

}  // namespace

ThresholdBound RefuseAtMost(const CalibrationSample& sample, double alpha) {
  const std::vector<double> scores = SolvableScores(sample);
  ThresholdBound bound;
  bound.scenes = static_cast<int>(scores.size());
  const auto k =
      static_cast<std::size_t>(std::floor(alpha * (static_cast<double>(scores.size()) + 1) + 1e-9));
  bound.kept = k > 0 && k <= scores.size() && scores[k - 1] != kNoPlan;
  if (bound.kept) bound.value = scores[k - 1];
  bound.count = static_cast<int>(std::lower_bound(scores.begin(), scores.end(), bound.value) -
                                 scores.begin());
  return bound;
}

int FirstTested(int attempts, double epsilon, double delta) {
  const int fewest = FewestThatCanPass(epsilon, delta);
  int n = fewest;
  while (n < kMostTested &&
         BinomialAtMost(MostFailures(n, epsilon, delta), n, epsilon / 4) < kWantedPower)
    ++n;
  return std::max(fewest, std::min(n, attempts / 2));
}

ThresholdBound FailAtMost(const CalibrationSample& sample, double epsilon, double delta) {
  const std::vector<CalibrationScene> attempts = Attempts(sample);
  const int all = static_cast<int>(attempts.size());
  const double level = delta / 2;  // of each sequence
  const int first = FirstTested(all, epsilon, level);
  ThresholdBound bound;
  bool going = true;
  int failures = 0;
  for (int n = 1; n <= all; ++n) {
    const CalibrationScene& last = attempts[static_cast<std::size_t>(n - 1)];
    failures += last.ending == SceneEnding::kFailed;
    // Equal scores are attempted together.
    const bool tied = n < all && attempts[static_cast<std::size_t>(n)].score == last.score;
    if (n < first || tied || (!going && n < all)) continue;
    going = BinomialAtMost(failures, n, epsilon) <= level;
    if (going) bound = {true, n == all ? 0 : last.score, n, failures};
  }
  return bound;
}

}  // namespace prospect::model
