#include "tools/evaluate/decider.h"

#include <algorithm>
#include <random>
#include <utility>

#include "sim/plan_rules.h"

namespace prospect::tools {
namespace {

class Nothing : public Decider {
 public:
  void Begin(std::uint64_t, const std::vector<std::uint8_t>&) override {}
  Decision Decide(const planner::Path&, const std::vector<std::uint8_t>&, sim::Task&) override {
    Decision decision;
    decision.reason = "does nothing";
    return decision;
  }
};

class Random : public Decider {
 public:
  explicit Random(Goal goal) : goal_(std::move(goal)) {}

  void Begin(std::uint64_t scene_seed, const std::vector<std::uint8_t>&) override {
    generator_.seed(scene_seed * 2654435761u + 17);
  }
  // Of what is possible now, what a plan of the task's length can go on with: a random legal plan.
  Decision Decide(const planner::Path& executed, const std::vector<std::uint8_t>&,
                  sim::Task& task) override {
    Decision decision;
    const std::vector<int> allowed = RulesOf(task.spec(), goal_).AllowedActions(executed, {});
    std::vector<int> legal;
    for (const int action : task.LegalActions()) {
      if (std::binary_search(allowed.begin(), allowed.end(), action)) legal.push_back(action);
    }
    if (!legal.empty()) decision.action = legal[generator_() % legal.size()];
    return decision;
  }

 private:
  Goal goal_;
  std::mt19937_64 generator_;
};

}  // namespace

planner::TaskRules RulesOf(const sim::TaskSpec& spec, const Goal& goal) {
  planner::TaskRules rules = sim::PlanRules(spec);
  std::vector<planner::ActionWords> words;
  for (const sim::ActionSpec& action : spec.actions) words.push_back({action.kind, action.object});
  planner::SetGoal(goal, words, &rules);
  return rules;
}

std::unique_ptr<Decider> MakeNothing() { return std::make_unique<Nothing>(); }
std::unique_ptr<Decider> MakeRandom(const Goal& goal) { return std::make_unique<Random>(goal); }

}  // namespace prospect::tools
