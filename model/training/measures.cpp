#include "model/training/measures.h"

#include <algorithm>

namespace prospect::model {
namespace {

double Share(std::size_t part, std::size_t all, double otherwise) {
  return all == 0 ? otherwise : static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace

double BalancedAccuracy(const Judgements& judgements, double threshold) {
  std::size_t trues = 0, hits = 0, falses = 0, rejections = 0;
  for (const Judgement& j : judgements) {
    (j.truth ? trues : falses) += 1;
    if (j.truth && j.score >= threshold) ++hits;
    if (!j.truth && j.score < threshold) ++rejections;
  }
  return 0.5 * (Share(hits, trues, 0.5) + Share(rejections, falses, 0.5));
}

double BestThreshold(const Judgements& judgements) {
  Judgements sorted = judgements;
  std::sort(sorted.begin(), sorted.end(),
            [](const Judgement& a, const Judgement& b) { return a.score < b.score; });
  const auto trues = static_cast<std::size_t>(
      std::count_if(sorted.begin(), sorted.end(), [](const Judgement& j) { return j.truth; }));
  const std::size_t falses = sorted.size() - trues;
  if (trues == 0 || falses == 0) return 0.5;
  double best = -1.0, threshold = 0.5;
  std::size_t trues_below = 0, falses_below = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || sorted[i].score > sorted[i - 1].score) {
      const double value = Share(trues - trues_below, trues, 0) + Share(falses_below, falses, 0);
      if (value > best) {
        best = value;
        threshold = sorted[i].score;
      }
    }
    (sorted[i].truth ? trues_below : falses_below) += 1;
  }
  return threshold;
}

double Recall(const Judgements& judgements, double threshold) {
  std::size_t trues = 0, hits = 0;
  for (const Judgement& j : judgements) {
    trues += j.truth;
    hits += j.truth && j.score > threshold;
  }
  return Share(hits, trues, 0);
}

double AreaUnderRoc(const Judgements& judgements) {
  Judgements sorted = judgements;
  std::sort(sorted.begin(), sorted.end(),
            [](const Judgement& a, const Judgement& b) { return a.score < b.score; });
  double trues = 0, falses = 0, wins = 0;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    double tied_trues = 0, tied_falses = 0;
    for (; end < sorted.size() && sorted[end].score == sorted[begin].score; ++end) {
      (sorted[end].truth ? tied_trues : tied_falses) += 1;
    }
    wins += tied_trues * (falses + 0.5 * tied_falses);
    trues += tied_trues;
    falses += tied_falses;
  }
  return trues == 0 || falses == 0 ? 0.5 : wins / (trues * falses);
}

double BaseRate(const Judgements& judgements) {
  std::size_t trues = 0;
  for (const Judgement& j : judgements) trues += j.truth;
  return Share(trues, judgements.size(), 0);
}

double BrierScore(const Judgements& judgements) {
  double sum = 0;
  for (const Judgement& j : judgements) {
    const double error = static_cast<double>(j.score) - (j.truth ? 1.0 : 0.0);
    sum += error * error;
  }
  return judgements.empty() ? 0 : sum / static_cast<double>(judgements.size());
}

double Accuracy(const Judgements& judgements) {
  std::size_t right = 0;
  for (const Judgement& j : judgements) right += (j.score >= 0.5F) == j.truth;
  return Share(right, judgements.size(), 0);
}

}  // namespace prospect::model
