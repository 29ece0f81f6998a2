#include "planner/selection_rule.h"

#include <cmath>
#include <stdexcept>

#include "planner/gumbel_rule.h"
#include "planner/path.h"

namespace prospect::planner {
namespace {

// A rule that looks at one child at a time, by Rule::Of(parent, child).
template <typename Rule>
class ChildByChild : public SelectionRule {
 public:
  void ScoreAll(const ParentView& parent, std::span<const ChildView> children,
                std::span<double> scores) const final {
    const Rule& rule = static_cast<const Rule&>(*this);
    for (std::size_t i = 0; i < children.size(); ++i) scores[i] = rule.Of(parent, children[i]);
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

class BestFirst : public ChildByChild<BestFirst> {
 public:
  // What is in flight is not open any more; but of several that choose at the same moment, before
  // they hear of each other, those that come later are to look elsewhere.
  double Of(const ParentView&, const ChildView& child) const {
    return child.open / (1 + kCrowd * static_cast<double>(child.in_flight));
  }
  Backup backup() const override { return Backup::kPlanScore; }
  bool asks_for_open() const override { return true; }

 private:
  static constexpr double kCrowd = 0.1;
};

class Random : public ChildByChild<Random> {
 public:
  double Of(const ParentView& parent, const ChildView& child) const {
    const auto round = static_cast<std::uint64_t>(parent.visits + parent.in_flight);
    return static_cast<double>(HashCombine(child.tie, round) >> 11);
  }
  Backup backup() const override { return Backup::kPlanScore; }
};

using Made = std::unique_ptr<const SelectionRule>;

struct NamedRule {
  const char* name;
  Made (*make)(double c, double c_puct);
};
constexpr NamedRule kRules[] = {
    {"paper", [](double c, double) -> Made { return std::make_unique<Paper>(c); }},
    {"puct", [](double, double c_puct) -> Made { return std::make_unique<Puct>(c_puct); }},
    {"gumbel", [](double, double) -> Made { return MakeGumbelRule(); }},
    {"best_first", [](double, double) -> Made { return std::make_unique<BestFirst>(); }},
    {"random", [](double, double) -> Made { return std::make_unique<Random>(); }},
};

}  // namespace

std::unique_ptr<const SelectionRule> MakeSelectionRule(std::string_view name, double c,
                                                       double c_puct) {
  std::string known;
  for (const NamedRule& rule : kRules) {
    if (name == rule.name) return rule.make(c, c_puct);
    known += std::string(" ") + rule.name;
  }
  throw std::invalid_argument("no selection rule '" + std::string(name) + "'; there are:" + known);
}

std::vector<std::string> SelectionRuleNames() {
  std::vector<std::string> names;
  for (const NamedRule& rule : kRules) names.emplace_back(rule.name);
  return names;
}

}  // namespace prospect::planner
