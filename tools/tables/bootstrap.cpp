#include "tools/tables/bootstrap.h"

#include <algorithm>

#include "model/training/random.h"

namespace prospect::tools {
namespace {

constexpr int kDraws = 1000;
constexpr std::uint64_t kSeed = 2018;

double MeanOf(double sum, double count) { return count > 0 ? sum / count : 0.0; }

double OneDraw(const std::vector<TrialSums>& trials, Column column, int draw) {
  model::CounterRandom random(kSeed, 0, static_cast<std::uint64_t>(draw));
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialSums& one =
        trials[static_cast<std::size_t>(random.Below(static_cast<std::int64_t>(trials.size())))];
    sum += one.sum[column];
    count += one.Count(column);
  }
  return MeanOf(sum, count);
}

}  // namespace

Estimate Bootstrap(const std::vector<TrialSums>& trials, Column column) {
  TrialSums total;
  for (const TrialSums& trial : trials) total.Add(trial);
  Estimate estimate;
  estimate.examples = total.Count(column);
  if (estimate.examples == 0) return estimate;
  estimate.value = MeanOf(total.sum[column], estimate.examples);
  std::vector<double> means;
  for (int draw = 0; draw < kDraws; ++draw) means.push_back(OneDraw(trials, column, draw));
  std::sort(means.begin(), means.end());
  estimate.low = means[kDraws / 40];
  estimate.high = means[kDraws - 1 - kDraws / 40];
  return estimate;
}

}  // namespace prospect::tools
