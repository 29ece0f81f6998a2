#include "planner/gumbel_rule.h"

#include <algorithm>
#include <cmath>

namespace prospect::planner {
namespace {

constexpr double kVisit = 50;
constexpr double kScale = 1;
// One visit too few or too many outweighs everything else at the root.
constexpr double kOneVisit = 1e6;
constexpr double kLeastPrior = 1e-6;

double Logit(const ParentView& parent, const ChildView& child) {
  return std::log(std::max(Prior(parent, child), kLeastPrior));
}

double Gumbel(std::uint64_t draw) {
  const double uniform = (static_cast<double>(draw >> 11) + 0.5) / 9007199254740992.0;  // 2^53
  return -std::log(-std::log(uniform));
}

double CompletedMean(const ParentView& parent, const ChildView& child) {
  return child.visits > 0 ? child.mean : parent.mean;
}

class GumbelRule : public SelectionRule {
 public:
  void ScoreAll(const ParentView& parent, std::span<const ChildView> children,
                std::span<double> scores) const override {
    std::int64_t most = 0;
    for (const ChildView& child : children) most = std::max(most, child.visits);
    const double sigma = (kVisit + static_cast<double>(most)) * kScale;
    for (std::size_t i = 0; i < children.size(); ++i) {
      scores[i] = Logit(parent, children[i]) + sigma * CompletedMean(parent, children[i]);
    }
    if (parent.root) {
      Halve(parent, children, scores);
    } else {
      FollowPolicy(children, scores);
    }
  }
  Backup backup() const override { return Backup::kPlanScore; }

 private:
  static void Halve(const ParentView& parent, std::span<const ChildView> children,
                    std::span<double> scores) {
    std::int64_t visit = 0;
    for (const ChildView& child : children) visit += child.visits + child.in_flight;
    const int actions = std::min(static_cast<int>(children.size()), kGumbelActions);
    const std::int64_t due = VisitsDue(visit, actions, parent.samples);
    for (std::size_t i = 0; i < children.size(); ++i) {
      const std::int64_t off = std::abs(children[i].visits + children[i].in_flight - due);
      scores[i] += Gumbel(children[i].draw) - kOneVisit * static_cast<double>(off);
    }
  }

  static void FollowPolicy(std::span<const ChildView> children, std::span<double> scores) {
    const double highest = *std::max_element(scores.begin(), scores.end());
    double sum = 0;
    double visits = 1;
    for (std::size_t i = 0; i < children.size(); ++i) {
      sum += scores[i] = std::exp(scores[i] - highest);
      visits += static_cast<double>(children[i].visits + children[i].in_flight);
    }
    for (std::size_t i = 0; i < children.size(); ++i) {
      const auto here = static_cast<double>(children[i].visits + children[i].in_flight);
      scores[i] = scores[i] / sum - here / visits;
    }
  }
};

}  // namespace

std::int64_t VisitsDue(std::int64_t visit, int actions, std::int64_t samples) {
  if (actions <= 1) return visit;
  int phases = 0;
  while ((1 << phases) < actions) ++phases;
  std::int64_t due = 0;
  for (int considered = actions;; considered = std::max(2, considered / 2)) {
    const std::int64_t each = std::max<std::int64_t>(1, samples / (phases * considered));
    if (visit < each * considered) return due + visit / considered;
    visit -= each * considered;
    due += each;
  }
}

std::unique_ptr<const SelectionRule> MakeGumbelRule() { return std::make_unique<GumbelRule>(); }

}  // namespace prospect::planner
