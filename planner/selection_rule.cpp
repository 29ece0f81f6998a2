#include "planner/selection_rule.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "planner/gumbel_rule.h"
#include "planner/path.h"

namespace prospect::planner {
namespace {

// A rule that looks at one child at a time, by Rule::Of(parent, child).
template <typename Rule>
class ChildByChild : public SelectionRule {
 public:
  void ScoreAll(const ParentView& parent, const ChildView* children, int count,
                double* scores) const final {
    const Rule& rule = static_cast<const Rule&>(*this);
    for (int i = 0; i < count; ++i) scores[i] = rule.Of(parent, children[i]);
  }
};

class Paper : public ChildByChild<Paper> {
 public:
  explicit Paper(double c) : c_(c) {}
  double Of(const ParentView&, const ChildView& child) const {
    const auto counted = static_cast<double>(child.visits + child.in_flight + 1);
    return c_ * child.q / counted + child.best;
  }
  Backup backup() const override { return Backup::kValueProduct; }

 private:
  double c_;
};

class PaperLiteral : public ChildByChild<PaperLiteral> {
 public:
  explicit PaperLiteral(double c) : c_(c) {}
  double Of(const ParentView&, const ChildView& child) const {
    const auto counted = static_cast<double>(child.visits + child.in_flight);
    if (counted == 0) return kFirst + child.q;
    return c_ * child.q / counted + child.best;
  }
  Backup backup() const override { return Backup::kValueProduct; }

 private:
  // Stands for the formula's infinity at N = 0, and leaves room to order by Q.
  static constexpr double kFirst = 1e9;
  double c_;
};

double PuctBonus(double c_puct, const ParentView& parent, const ChildView& child) {
  const auto tried = static_cast<double>(parent.visits + parent.in_flight);
  const auto here = static_cast<double>(child.visits + child.in_flight);
  return c_puct * Prior(parent, child) * std::sqrt(tried) / (1 + here);
}

class Puct : public ChildByChild<Puct> {
 public:
  explicit Puct(double c_puct) : c_puct_(c_puct) {}
  double Of(const ParentView& parent, const ChildView& child) const {
    const double mean = child.visits > 0 ? child.mean : parent.mean;
    return mean + PuctBonus(c_puct_, parent, child);
  }
  Backup backup() const override { return Backup::kPlanScore; }

 private:
  double c_puct_;
};

class PuctVirtualLoss : public ChildByChild<PuctVirtualLoss> {
 public:
  explicit PuctVirtualLoss(double c_puct) : c_puct_(c_puct) {}
  double Of(const ParentView& parent, const ChildView& child) const {
    return MeanWithLosses(parent, child) + PuctBonus(c_puct_, parent, child);
  }
  Backup backup() const override { return Backup::kPlanScore; }

 private:
  static double MeanWithLosses(const ParentView& parent, const ChildView& child) {
    const std::int64_t counted = child.visits + child.in_flight;
    if (counted == 0) return parent.mean;
    return child.mean * static_cast<double>(child.visits) / static_cast<double>(counted);
  }
  double c_puct_;
};

class Random : public ChildByChild<Random> {
 public:
  double Of(const ParentView& parent, const ChildView& child) const {
    const auto round = static_cast<std::uint64_t>(parent.visits + parent.in_flight);
    return static_cast<double>(HashCombine(child.tie, round) >> 11);
  }
  Backup backup() const override { return Backup::kPlanScore; }
};

std::string AllNames() {
  std::string names;
  for (const std::string& name : SelectionRuleNames()) names += " " + name;
  return names;
}

}  // namespace

std::unique_ptr<const SelectionRule> MakeSelectionRule(const std::string& name, double c,
                                                       double c_puct) {
  if (name == "paper") return std::make_unique<Paper>(c);
  if (name == "paper-literal") return std::make_unique<PaperLiteral>(c);
  if (name == "puct") return std::make_unique<Puct>(c_puct);
  if (name == "puct-virtual-loss") return std::make_unique<PuctVirtualLoss>(c_puct);
  if (name == "gumbel") return MakeGumbelRule();
  if (name == "random") return std::make_unique<Random>();
  throw std::invalid_argument("no selection rule '" + name + "'; there are:" + AllNames());
}

const std::vector<std::string>& SelectionRuleNames() {
  static const std::vector<std::string> names = {"paper", "paper-literal", "puct",
                                                 "puct-virtual-loss", "random"};
  return names;
}

}  // namespace prospect::planner
