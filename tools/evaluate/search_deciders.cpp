#include "tools/evaluate/search_deciders.h"

#include <algorithm>
#include <utility>

#include "planner/baseline_plans.h"
#include "planner/model_source.h"
#include "tools/evaluate/engine_model.h"
#include "tools/evaluate/simulator_model.h"

namespace prospect::tools {
namespace {

// The learned networks in this process.
class EngineMind : public LocalMind {
 public:
  EngineMind(PlanBy by, model::Engine* engine) : by_(by), engine_(engine), model_(engine) {}

  void Enter(sim::Task&, std::uint64_t) override { frame_ = -1; }

  agent::MindInfo Choose() override {
    const model::EngineInfo& info = engine_->info();
    return {info.engine, "", info.refusal_threshold};
  }

  std::map<planner::Path, planner::Evaluation> Judge(
      const std::vector<planner::Path>& paths) override {
    std::map<planner::Path, planner::Evaluation> evaluations;
    for (const auto& path : paths) evaluations[path] = model_.Evaluate(path);
    return evaluations;
  }

  std::map<planner::Path, agent::Picture> Imagine(
      const std::vector<planner::Path>& paths) override {
    const model::EngineInfo& info = engine_->info();
    std::vector<std::vector<std::uint8_t>> painted = model_.Imagine(paths);
    std::map<planner::Path, agent::Picture> pictures;
    for (std::size_t i = 0; i < paths.size(); ++i)
      pictures[paths[i]] = {info.image_width, info.image_height, std::move(painted[i])};
    return pictures;
  }

 private:
  agent::SearchAnswer Find(const agent::SearchQuestion& question) override {
    LookAt(question);
    if (by_ == PlanBy::kSearch) return SearchWith(question, &model_);
    agent::SearchAnswer answer;
    if (by_ == PlanBy::kExhaustive) {
      planner::ExhaustiveResult all =
          planner::ExhaustivePlan(question.rules, question.parameters, question.executed, &model_);
      answer.plan = std::move(all.plan);
      answer.evaluations = all.evaluations;
    } else {
      answer.plan = planner::PlanOf(
          planner::GreedyPlan(question.rules, question.parameters, question.executed, &model_),
          "nothing is permitted");
      answer.evaluations = model_.evaluations();
    }
    return answer;
  }

  // What was imagined from a picture stays known while it is the present one.
  void LookAt(const agent::SearchQuestion& question) {
    if (frame_ < 0) model_.SetFirst(question.first.picture.rgb);
    if (frame_ == question.present.frame) return;
    frame_ = question.present.frame;
    model_.SetRoot(question.present.picture.rgb, question.executed.empty()
                                                     ? question.rules.num_actions
                                                     : question.executed.back());
  }

  PlanBy by_;
  model::Engine* engine_;
  EngineModel model_;
  std::int64_t frame_ = -1;  // of the present picture; -1: a new scene
};

// Searches with the world itself.
class SimulatorMind : public LocalMind {
 public:
  explicit SimulatorMind(int runs) : runs_(runs) {}

  void Enter(sim::Task& task, std::uint64_t scene_seed) override {
    task_ = &task;
    seed_ = scene_seed;
    begun_ = -1;
  }

 private:
  agent::SearchAnswer Find(const agent::SearchQuestion& question) override {
    const int begun = task_->progress().segment + 1;  // actions
    if (begun != begun_) {
      model_ = std::make_unique<SimulatorModel>(
          task_, seed_ * 31 + static_cast<std::uint64_t>(begun) + 0x51517, runs_);
      begun_ = begun;
    }
    agent::SearchQuestion own = question;
    own.parameters.seed = seed_;  // what is 0 or 1 ties: no two scenes are to break ties alike
    return SearchWith(own, model_.get());
  }

  int runs_;
  sim::Task* task_ = nullptr;
  std::uint64_t seed_ = 0;
  int begun_ = -1;
  std::unique_ptr<SimulatorModel> model_;
};

}  // namespace

std::unique_ptr<Decider> MakeLearned(PlanBy by, model::Engine* engine,
                                     const planner::SearchParameters& parameters, const Goal& goal,
                                     int retries, double surprise) {
  auto decider = std::make_unique<Decider>();
  decider->mind = std::make_unique<EngineMind>(by, engine);
  agent::EpisodeOptions& options = decider->options;
  options.search = parameters;
  options.refusal_threshold = parameters.refusal_threshold;
  options.goal = planner::ToString(goal);
  options.retries = by == PlanBy::kGreedy ? 0 : retries;
  options.surprise = surprise;
  options.novelty = 0;
  return decider;
}

std::unique_ptr<Decider> MakeSimulatorModel(int runs, const planner::SearchParameters& parameters,
                                            const Goal& goal, int retries) {
  auto decider = std::make_unique<Decider>();
  decider->mind = std::make_unique<SimulatorMind>(runs);
  agent::EpisodeOptions& options = decider->options;
  options.search = parameters;
  options.refusal_threshold = 0.5;
  options.goal = planner::ToString(goal);
  options.retries = retries;
  options.surprise = 1;
  options.novelty = 0;
  return decider;
}

}  // namespace prospect::tools
