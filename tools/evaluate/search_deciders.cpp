#include "tools/evaluate/search_deciders.h"

#include <utility>

#include "planner/baseline_plans.h"
#include "planner/model_source.h"
#include "planner/search.h"
#include "tools/evaluate/crew_search.h"
#include "tools/evaluate/engine_model.h"
#include "tools/evaluate/simulator_model.h"

namespace prospect::tools {
namespace {

planner::SearchParameters ForRoot(planner::SearchParameters parameters,
                                  const planner::TaskRules& rules, const planner::Path& executed,
                                  std::uint64_t scene_seed) {
  const int left = rules.plan_length - static_cast<int>(executed.size());
  if (parameters.depth <= 0 || parameters.depth > left) parameters.depth = left;
  parameters.seed = scene_seed;
  return parameters;
}

Decision FromPlan(const planner::Plan& plan) {
  Decision decision;
  decision.score = plan.best.score;
  decision.reason = plan.reason;
  if (plan.ok() && !plan.best.path.empty()) decision.action = plan.best.path.front();
  return decision;
}

Decision SearchTogether(const planner::TaskRules& rules,
                        const planner::SearchParameters& parameters, const planner::Path& executed,
                        planner::ModelSource* model) {
  const CrewResult result = SearchWithCrew(rules, parameters, executed, model);
  Decision decision = FromPlan(result.plan);
  decision.rollouts = result.rollouts;
  decision.evaluations = result.evaluations;
  return decision;
}

Decision SearchWith(const planner::TaskRules& rules, const planner::SearchParameters& parameters,
                    const planner::Path& executed, planner::ModelSource* model) {
  if (parameters.workers > 1) return SearchTogether(rules, parameters, executed, model);
  planner::Search search(rules, parameters, executed, planner::SearchIdentity{});
  planner::RunSearch(&search, model, 1);
  Decision decision = FromPlan(search.BestPlan());
  decision.rollouts = search.rollouts();
  decision.evaluations = search.known_evaluations();
  return decision;
}

class Learned : public Decider {
 public:
  Learned(PlanBy by, model::Engine* engine, const planner::SearchParameters& parameters, Goal goal)
      : by_(by), parameters_(parameters), goal_(std::move(goal)), model_(engine) {}

  void Begin(std::uint64_t scene_seed, const std::vector<std::uint8_t>& first) override {
    seed_ = scene_seed;
    model_.SetFirst(first);
  }

  Decision Decide(const planner::Path& executed, const std::vector<std::uint8_t>& latest,
                  sim::Task& task) override {
    const planner::TaskRules rules = RulesOf(task.spec(), goal_);
    model_.SetRoot(latest, executed.empty() ? rules.num_actions : executed.back());
    const planner::SearchParameters parameters = ForRoot(parameters_, rules, executed, seed_);
    if (by_ == PlanBy::kSearch) return SearchWith(rules, parameters, executed, &model_);
    Decision decision = by_ == PlanBy::kGreedy ? Greedy(rules, parameters, executed)
                                               : Exhaustive(rules, parameters, executed);
    decision.evaluations = model_.evaluations();
    return decision;
  }

 private:
  Decision Greedy(const planner::TaskRules& rules, const planner::SearchParameters& parameters,
                  const planner::Path& executed) {
    const planner::Path plan = planner::GreedyPlan(rules, parameters, executed, &model_);
    Decision decision;
    decision.reason = "nothing is permitted";
    if (!plan.empty()) decision.action = plan.front();
    return decision;
  }

  Decision Exhaustive(const planner::TaskRules& rules, const planner::SearchParameters& parameters,
                      const planner::Path& executed) {
    return FromPlan(planner::ExhaustivePlan(rules, parameters, executed, &model_).plan);
  }

  PlanBy by_;
  planner::SearchParameters parameters_;
  Goal goal_;
  EngineModel model_;
  std::uint64_t seed_ = 0;
};

class WithSimulator : public Decider {
 public:
  WithSimulator(const planner::SearchParameters& parameters, Goal goal)
      : parameters_(parameters), goal_(std::move(goal)) {
    parameters_.refusal_threshold = 0.5;  // one imagined run succeeds or fails
  }

  void Begin(std::uint64_t scene_seed, const std::vector<std::uint8_t>&) override {
    seed_ = scene_seed;
  }

  Decision Decide(const planner::Path& executed, const std::vector<std::uint8_t>&,
                  sim::Task& task) override {
    const planner::TaskRules rules = RulesOf(task.spec(), goal_);
    SimulatorModel model(&task, seed_ * 31 + executed.size() + 0x51517);
    return SearchWith(rules, ForRoot(parameters_, rules, executed, seed_), executed, &model);
  }

 private:
  planner::SearchParameters parameters_;
  Goal goal_;
  std::uint64_t seed_ = 0;
};

}  // namespace

std::unique_ptr<Decider> MakeLearned(PlanBy by, model::Engine* engine,
                                     const planner::SearchParameters& parameters,
                                     const Goal& goal) {
  return std::make_unique<Learned>(by, engine, parameters, goal);
}

std::unique_ptr<Decider> MakeSimulatorModel(const planner::SearchParameters& parameters,
                                            const Goal& goal) {
  return std::make_unique<WithSimulator>(parameters, goal);
}

}  // namespace prospect::tools
