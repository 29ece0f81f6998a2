#include "tools/evaluate/search_deciders.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "model/surprise.h"
#include "planner/attempts.h"
#include "planner/baseline_plans.h"
#include "planner/model_source.h"
#include "planner/search.h"
#include "tools/evaluate/crew_search.h"
#include "tools/evaluate/engine_model.h"
#include "tools/evaluate/simulator_model.h"

namespace prospect::tools {
namespace {

// A plan, and what looking for it took.
struct Found {
  planner::Plan plan;
  std::int64_t rollouts = 0;
  std::int64_t evaluations = 0;
};

planner::SearchParameters ForRoot(planner::SearchParameters parameters,
                                  const planner::TaskRules& rules, const planner::Path& executed,
                                  std::uint64_t scene_seed) {
  const int left = rules.plan_length - static_cast<int>(executed.size());
  if (parameters.depth <= 0 || parameters.depth > left) parameters.depth = left;
  parameters.seed = scene_seed;
  return parameters;
}

Found SearchWith(const planner::TaskRules& rules, const planner::SearchParameters& parameters,
                 const planner::Path& executed, planner::ModelSource* model) {
  if (parameters.workers > 1) {
    CrewResult crew = SearchWithCrew(rules, parameters, executed, model);
    return {std::move(crew.plan), crew.rollouts, crew.evaluations};
  }
  planner::Search search(rules, parameters, executed, planner::SearchIdentity{});
  planner::RunSearch(&search, model, 1);
  return {search.BestPlan(), search.rollouts(), search.known_evaluations()};
}

// Decides by searching what is left of the plan, or of the plan begun anew.
class Searching : public Decider {
 public:
  Searching(planner::SearchParameters parameters, Goal goal, int retries, double surprise = 1)
      : parameters_(std::move(parameters)),
        goal_(std::move(goal)),
        retries_(retries),
        disbelief_{surprise, std::max(surprise, model::kAlarming)} {}

  void Begin(std::uint64_t scene_seed, const std::vector<std::uint8_t>&) override {
    seed_ = scene_seed;
    attempts_.reset();
    followed_ = 0;
  }

  Decision Decide(const planner::Path& executed, const std::vector<std::uint8_t>& latest,
                  sim::Task& task) override {
    rules_ = RulesOf(task.spec(), goal_);
    if (!attempts_) attempts_.emplace(rules_, retries_, disbelief_);
    for (; followed_ < executed.size(); ++followed_) attempts_->CarriedOut(executed[followed_]);
    Look(executed, latest, task);
    Decision decision;
    const auto search = [&](const planner::Attempt& attempt) {
      const planner::TaskRules rules = planner::RulesFor(rules_, attempt);
      Found found =
          Find(rules, ForRoot(parameters_, rules, attempt.executed, seed_), attempt.executed);
      decision.rollouts += found.rollouts;
      decision.evaluations += found.evaluations;
      return std::move(found.plan);
    };
    const std::size_t of_plan = static_cast<std::size_t>(attempts_->followed());
    if (of_plan > 0 && attempts_->heeds_surprises()) {
      const planner::Path since(executed.end() - static_cast<std::ptrdiff_t>(of_plan),
                                executed.end());
      decision.surprise = Surprise(since, latest);
    }
    const planner::NextStep next = attempts_->Next(search, decision.surprise);
    if (next.action >= 0 && attempts_->followed() == 0) RememberStart();
    decision.action = next.action;
    decision.score = next.plan.best.score;
    if (next.plan.ok()) decision.plan = next.plan.best.path;
    decision.reason = next.plan.reason;
    decision.anew = next.kind == planner::NextStep::Kind::kAnew;
    decision.carried_on = next.kind == planner::NextStep::Kind::kCarryOn;
    return decision;
  }

 protected:
  // The world as it is now, after all of `executed`.
  virtual void Look(const planner::Path& executed, const std::vector<std::uint8_t>& latest,
                    sim::Task& task) = 0;
  virtual Found Find(const planner::TaskRules& rules, const planner::SearchParameters& parameters,
                     const planner::Path& executed) = 0;
  // A plan begins from what was looked at last.
  virtual void RememberStart() {}
  // model::Surprise of `latest` and of what the plan imagined for it, after `since` of its actions.
  virtual double Surprise(const planner::Path&, const std::vector<std::uint8_t>&) { return 0; }

  const planner::TaskRules& rules() const { return rules_; }
  std::uint64_t seed() const { return seed_; }

 private:
  planner::SearchParameters parameters_;
  Goal goal_;
  int retries_;
  planner::Disbelief disbelief_;
  std::uint64_t seed_ = 0;
  planner::TaskRules rules_;
  std::optional<planner::Attempts> attempts_;
  std::size_t followed_ = 0;  // actions that attempts_ knows to be carried out
};

class Learned : public Searching {
 public:
  Learned(bool exhaustive, model::Engine* engine, const planner::SearchParameters& parameters,
          Goal goal, int retries, double surprise)
      : Searching(parameters, std::move(goal), retries, surprise),
        exhaustive_(exhaustive),
        width_(engine->info().image_width),
        height_(engine->info().image_height),
        model_(engine) {}

  void Begin(std::uint64_t scene_seed, const std::vector<std::uint8_t>& first) override {
    Searching::Begin(scene_seed, first);
    model_.SetFirst(first);
  }

 private:
  void Look(const planner::Path& executed, const std::vector<std::uint8_t>& latest,
            sim::Task&) override {
    model_.SetRoot(latest, executed.empty() ? rules().num_actions : executed.back());
  }

  Found Find(const planner::TaskRules& rules, const planner::SearchParameters& parameters,
             const planner::Path& executed) override {
    if (!exhaustive_) return SearchWith(rules, parameters, executed, &model_);
    planner::ExhaustiveResult all = planner::ExhaustivePlan(rules, parameters, executed, &model_);
    return {std::move(all.plan), 0, all.evaluations};
  }

  void RememberStart() override { start_ = model_.glance(); }

  double Surprise(const planner::Path& since, const std::vector<std::uint8_t>& latest) override {
    return model::Surprise(model_.Imagine(start_, since), latest, width_, height_);
  }

  bool exhaustive_;
  int width_, height_;
  EngineModel model_;
  Glance start_;
};

class Greedy : public Decider {
 public:
  Greedy(model::Engine* engine, planner::SearchParameters parameters, Goal goal)
      : parameters_(std::move(parameters)), goal_(std::move(goal)), model_(engine) {}

  void Begin(std::uint64_t scene_seed, const std::vector<std::uint8_t>& first) override {
    seed_ = scene_seed;
    model_.SetFirst(first);
  }

  Decision Decide(const planner::Path& executed, const std::vector<std::uint8_t>& latest,
                  sim::Task& task) override {
    const planner::TaskRules rules = RulesOf(task.spec(), goal_);
    model_.SetRoot(latest, executed.empty() ? rules.num_actions : executed.back());
    const planner::Path plan =
        planner::GreedyPlan(rules, ForRoot(parameters_, rules, executed, seed_), executed, &model_);
    Decision decision;
    decision.reason = "nothing is permitted";
    if (!plan.empty()) decision.action = plan.front();
    decision.plan = plan;
    decision.evaluations = model_.evaluations();
    return decision;
  }

 private:
  planner::SearchParameters parameters_;
  Goal goal_;
  EngineModel model_;
  std::uint64_t seed_ = 0;
};

// One imagined run succeeds or fails.
planner::SearchParameters OfCertainModel(planner::SearchParameters parameters) {
  parameters.refusal_threshold = 0.5;
  return parameters;
}

class WithSimulator : public Searching {
 public:
  WithSimulator(const planner::SearchParameters& parameters, Goal goal, int retries)
      : Searching(OfCertainModel(parameters), std::move(goal), retries) {}

 private:
  void Look(const planner::Path& executed, const std::vector<std::uint8_t>&,
            sim::Task& task) override {
    model_ = std::make_unique<SimulatorModel>(&task, seed() * 31 + executed.size() + 0x51517);
  }

  Found Find(const planner::TaskRules& rules, const planner::SearchParameters& parameters,
             const planner::Path& executed) override {
    return SearchWith(rules, parameters, executed, model_.get());
  }

  std::unique_ptr<SimulatorModel> model_;
};

}  // namespace

std::unique_ptr<Decider> MakeLearned(PlanBy by, model::Engine* engine,
                                     const planner::SearchParameters& parameters, const Goal& goal,
                                     int retries, double surprise) {
  if (by == PlanBy::kGreedy) return std::make_unique<Greedy>(engine, parameters, goal);
  return std::make_unique<Learned>(by == PlanBy::kExhaustive, engine, parameters, goal, retries,
                                   surprise);
}

std::unique_ptr<Decider> MakeSimulatorModel(const planner::SearchParameters& parameters,
                                            const Goal& goal, int retries) {
  return std::make_unique<WithSimulator>(parameters, goal, retries);
}

}  // namespace prospect::tools
