#include "tools/ceiling/foretold.h"

#include <algorithm>

namespace prospect::tools {
namespace {

double Balanced(const std::vector<Foretold>& moments, double threshold) {
  double yes = 0, yes_told = 0, no = 0, no_told = 0;
  for (const Foretold& m : moments) {
    const bool told = m.probability >= threshold;
    yes += m.share, no += 1 - m.share;
    (told ? yes_told : no_told) += told ? m.share : 1 - m.share;
  }
  return yes > 0 && no > 0 ? (yes_told / yes + no_told / no) / 2 : 0.5;
}

// Over ascending groups of equal probability; a tie counts half.
double Area(std::vector<Foretold> moments) {
  std::sort(moments.begin(), moments.end(),
            [](const Foretold& a, const Foretold& b) { return a.probability < b.probability; });
  double yes = 0, no = 0, pairs = 0;
  for (std::size_t i = 0; i < moments.size();) {
    double group_yes = 0, group_no = 0;
    const double probability = moments[i].probability;
    for (; i < moments.size() && moments[i].probability == probability; ++i) {
      group_yes += moments[i].share, group_no += 1 - moments[i].share;
    }
    pairs += group_yes * (no + group_no / 2);
    yes += group_yes, no += group_no;
  }
  return yes > 0 && no > 0 ? pairs / (yes * no) : 0.5;
}

}  // namespace

Scores ScoresOf(const std::vector<Foretold>& moments) {
  Scores scores;
  scores.moments = static_cast<int>(moments.size());
  if (moments.empty()) return scores;
  double right = 0;
  for (const Foretold& m : moments) {
    scores.base_rate += m.share / scores.moments;
    right += m.probability >= 0.5 ? m.share : 1 - m.share;
    scores.best_balanced = std::max(scores.best_balanced, Balanced(moments, m.probability));
  }
  scores.majority = std::max(scores.base_rate, 1 - scores.base_rate);
  scores.accuracy = right / scores.moments;
  scores.balanced = Balanced(moments, 0.5);
  scores.area_under_roc = Area(moments);
  return scores;
}

}  // namespace prospect::tools
