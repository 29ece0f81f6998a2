#pragma once

namespace prospect::model {

// Exact probabilities of counts, by sums of their terms. Pure functions.

/// P(X <= k) for X ~ Binomial(n, p). k may be negative (0) or n and more (1); n >= 0, p in [0,1].
double BinomialAtMost(int k, int n, double p);

/// P(X <= k) for X ~ BetaBinomial(n, a, b): a binomial whose share is Beta(a, b). a, b > 0.
double BetaBinomialAtMost(int k, int n, double a, double b);

/// Counts between two bounds, both included.
struct CountBand {
  int low = 0;
  int high = 0;
  bool Holds(int count) const { return low <= count && count <= high; }
};

/// The counts of BetaBinomial(n, a, b) with at most (1 - level) / 2 beyond each end.
/// The share of new scenes below the k-th smallest of m calibration scores is Beta(k, m + 1 - k)
/// (Vovk 2012), so that of n new ones BetaBinomial(n, k, m + 1 - k) lie below it.
CountBand BetaBinomialBand(int n, double a, double b, double level);

/// 0 to the largest count of Binomial(n, p) with at most (1 - level) / 2 beyond it: what a share of
/// at most p may show.
CountBand BinomialBandFromZero(int n, double p, double level);

}  // namespace prospect::model
