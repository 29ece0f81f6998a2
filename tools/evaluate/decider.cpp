#include "tools/evaluate/decider.h"

#include <algorithm>
#include <random>
#include <utility>

#include "planner/baseline_plans.h"
#include "sim/plan_rules.h"
#include "tools/evaluate/simulated_world.h"

namespace prospect::tools {
namespace {

class Nothing : public LocalMind {
 public:
  void Enter(sim::Task&, std::uint64_t) override {}

 private:
  agent::SearchAnswer Find(const agent::SearchQuestion&) override {
    agent::SearchAnswer answer;
    answer.plan = planner::PlanOf({}, "does nothing");
    return answer;
  }
};

class Random : public LocalMind {
 public:
  void Enter(sim::Task& task, std::uint64_t scene_seed) override {
    task_ = &task;
    generator_.seed(scene_seed * 2654435761u + 17);
  }

 private:
  // Of what is possible now, what a plan of the task's length can go on with: a random legal plan.
  agent::SearchAnswer Find(const agent::SearchQuestion& question) override {
    const std::vector<int> allowed = question.rules.AllowedActions(question.executed, {});
    std::vector<int> legal;
    for (const int action : task_->LegalActions()) {
      if (std::binary_search(allowed.begin(), allowed.end(), action)) legal.push_back(action);
    }
    planner::Path plan;
    if (!legal.empty())
      plan.push_back(static_cast<std::uint8_t>(legal[generator_() % legal.size()]));
    agent::SearchAnswer answer;
    answer.plan = planner::PlanOf(plan, "nothing is possible");
    return answer;
  }

  sim::Task* task_ = nullptr;
  std::mt19937_64 generator_;
};

// Of minds that judge nothing: no safeguard applies to them.
std::unique_ptr<Decider> Plain(std::unique_ptr<LocalMind> mind, const Goal& goal) {
  auto decider = std::make_unique<Decider>();
  decider->mind = std::move(mind);
  decider->plans_ahead = false;
  decider->options.goal = planner::ToString(goal);
  decider->options.retries = 0;
  decider->options.novelty = 0;
  return decider;
}

}  // namespace

planner::TaskRules RulesOf(const sim::TaskSpec& spec, const Goal& goal) {
  planner::TaskRules rules = sim::PlanRules(spec);
  planner::SetGoal(planner::TermsOf(goal, GoalsOf(spec)), &rules);
  return rules;
}

std::unique_ptr<Decider> MakeNothing() { return Plain(std::make_unique<Nothing>(), {}); }

std::unique_ptr<Decider> MakeRandom(const Goal& goal) {
  return Plain(std::make_unique<Random>(), goal);
}

std::unique_ptr<Decider> MakeNoveltyGate(std::unique_ptr<Decider> decider, model::Engine* engine,
                                         const model::NoveltyGauge& gauge, double level) {
  decider->mind->Recognise(engine, gauge);
  decider->options.novelty = level;
  return decider;
}

std::unique_ptr<Decider> MakeOpenLoop(std::unique_ptr<Decider> decider) {
  decider->options.open_loop = decider->plans_ahead;
  return decider;
}

}  // namespace prospect::tools
