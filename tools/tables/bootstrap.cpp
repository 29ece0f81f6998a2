#include "tools/tables/bootstrap.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

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

double Mean(const std::vector<TrialSums>& trials, Column column) {
  TrialSums total;
  for (const TrialSums& trial : trials) total.Add(trial);
  return MeanOf(total.sum[column], total.Count(column));
}

double Examples(const std::vector<TrialSums>& trials, Column column) {
  double examples = 0;
  for (const TrialSums& trial : trials) examples += trial.Count(column);
  return examples;
}

// `value` between the percentiles of `one_draw`.
Estimate Between(double value, double examples, const std::function<double(int)>& one_draw) {
  std::vector<double> means;
  for (int draw = 0; draw < kDraws; ++draw) means.push_back(one_draw(draw));
  std::sort(means.begin(), means.end());
  return {value, means[kDraws / 40], means[kDraws - 1 - kDraws / 40], examples};
}

}  // namespace

Estimate Bootstrap(const std::vector<TrialSums>& trials, Column column) {
  const double examples = Examples(trials, column);
  if (examples == 0) return {};
  return Between(Mean(trials, column), examples,
                 [&](int draw) { return OneDraw(trials, column, draw); });
}

Estimate BootstrapDifference(const std::vector<TrialSums>& trials,
                             const std::vector<TrialSums>& others, Column column) {
  if (trials.size() != others.size())
    throw std::invalid_argument("rows to compare are of different trials");
  const double examples = std::min(Examples(trials, column), Examples(others, column));
  if (examples == 0) return {};
  return Between(Mean(trials, column) - Mean(others, column), examples, [&](int draw) {
    return OneDraw(trials, column, draw) - OneDraw(others, column, draw);
  });
}

}  // namespace prospect::tools
