#pragma once

#include <cstddef>
#include <vector>

namespace prospect::model {

/// A predicted probability and what was true.
struct Judgement {
  float score = 0;
  bool truth = false;
};
using Judgements = std::vector<Judgement>;

/// Mean of the share of true ones scored at or above `threshold` and the share of false ones below
/// it; 0.5 is what every constant answer gets. A class without members counts as 0.5.
double BalancedAccuracy(const Judgements& judgements, double threshold);

/// The threshold with the best balanced accuracy (the lowest of equals); 0.5 if there are no
/// judgements of both kinds. To be chosen on validation trials and used on test trials.
double BestThreshold(const Judgements& judgements);

/// Share of true ones scored above `threshold`; 0 if there are none.
double Recall(const Judgements& judgements, double threshold);

/// Area under the ROC curve: the chance that a true one is scored above a false one, equal scores
/// counting half; 0.5 if there are no judgements of both kinds.
double AreaUnderRoc(const Judgements& judgements);

/// Share of true ones; 0 if there are none at all.
double BaseRate(const Judgements& judgements);

/// Mean squared difference of score and truth; lower is better. Always answering the base rate b
/// gets b(1-b).
double BrierScore(const Judgements& judgements);

/// Share of judgements on the right side of 0.5.
double Accuracy(const Judgements& judgements);

}  // namespace prospect::model
