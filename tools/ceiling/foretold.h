#pragma once

#include <vector>

namespace prospect::tools {

// A moment: the probability that is foretold of it, and how often it came true.
struct Foretold {
  double probability = 0;
  double share = 0;
};

// What whoever foretells these probabilities scores against outcomes that come true with those
// shares: at most what any predictor could, if the probabilities are the true ones. Each moment
// weighs the same.
struct Scores {
  int moments = 0;
  double base_rate = 0;      // mean share
  double majority = 0;       // accuracy of always saying the more frequent outcome
  double accuracy = 0;       // saying "yes" from probability 0.5 on
  double balanced = 0;       // mean of the shares of yes and of no that are told so, at 0.5
  double best_balanced = 0;  // and at the threshold that suits best
  double area_under_roc = 0;
};

// Shares that nobody has (all yes or all no) leave balanced accuracy and area at 0.5.
Scores ScoresOf(const std::vector<Foretold>& moments);

}  // namespace prospect::tools
