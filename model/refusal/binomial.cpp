#include "model/refusal/binomial.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace prospect::model {
namespace {

// std::lgamma writes to a global; its argument is positive here, so the sign does not matter.
double LogGamma(double x) {
  int sign = 0;
  return lgamma_r(x, &sign);
}

double LogChoose(int n, int k) {
  return LogGamma(n + 1.0) - LogGamma(k + 1.0) - LogGamma(n - k + 1.0);
}

double LogBeta(double a, double b) { return LogGamma(a) + LogGamma(b) - LogGamma(a + b); }

double SumOfTerms(int k, const std::function<double(int)>& log_term) {
  double sum = 0;
  for (int i = 0; i <= k; ++i) sum += std::exp(log_term(i));
  return std::min(1.0, sum);
}

// The smallest count that is not exceeded with more than `beyond`.
int SmallestNotExceeded(int n, double beyond, const std::function<double(int)>& at_most) {
  int k = 0;
  while (k < n && 1 - at_most(k) > beyond) ++k;
  return k;
}

}  // namespace

double BinomialAtMost(int k, int n, double p) {
  if (k < 0) return 0;
  if (k >= n || p <= 0) return 1;
  if (p >= 1) return 0;
  const double hit = std::log(p), miss = std::log1p(-p);
  return SumOfTerms(k, [&](int i) { return LogChoose(n, i) + i * hit + (n - i) * miss; });
}

double BetaBinomialAtMost(int k, int n, double a, double b) {
  if (k < 0) return 0;
  if (k >= n) return 1;
  const double all = LogBeta(a, b);
  return SumOfTerms(k, [&](int i) { return LogChoose(n, i) + LogBeta(i + a, n - i + b) - all; });
}

CountBand BetaBinomialBand(int n, double a, double b, double level) {
  const double beyond = (1 - level) / 2;
  CountBand band;
  while (band.low < n && BetaBinomialAtMost(band.low, n, a, b) <= beyond) ++band.low;
  band.high = SmallestNotExceeded(n, beyond, [&](int k) { return BetaBinomialAtMost(k, n, a, b); });
  return band;
}

CountBand BinomialBandFromZero(int n, double p, double level) {
  return {0,
          SmallestNotExceeded(n, (1 - level) / 2, [&](int k) { return BinomialAtMost(k, n, p); })};
}

}  // namespace prospect::model
