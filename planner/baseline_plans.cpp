#include "planner/baseline_plans.h"

#include <algorithm>
#include <stdexcept>

#include "planner/plan_reader.h"

namespace prospect::planner {
namespace {

// Breadth first over everything the task allows, a batch at a time.
class Expansion {
 public:
  Expansion(const TaskRules& rules, const SearchParameters& parameters, const Path& executed,
            ModelSource* model, bool prune)
      : rules_(rules),
        parameters_(parameters),
        executed_(executed),
        model_(model),
        prune_(prune),
        paths_(rules.num_actions),
        evaluations_(&paths_) {}

  ExhaustiveResult Run(int batch);

 private:
  void EvaluateSome(std::size_t begin, std::size_t end);
  void QueueChildren(PathId id);
  bool Hopeless(PathId id) const;

  const TaskRules& rules_;
  const SearchParameters& parameters_;
  const Path& executed_;
  ModelSource* model_;
  bool prune_;
  PathTree paths_;
  EvaluationTable evaluations_;
  std::vector<PathId> queue_{kRoot};
};

ExhaustiveResult Expansion::Run(int batch) {
  for (std::size_t begin = 0; begin < queue_.size();) {
    const std::size_t end = std::min(queue_.size(), begin + static_cast<std::size_t>(batch));
    EvaluateSome(begin, end);
    for (; begin < end; ++begin) QueueChildren(queue_[begin]);
  }
  PlanSource source;
  source.paths = &paths_;
  source.evaluations = &evaluations_;
  source.rules = &rules_;
  source.parameters = &parameters_;
  source.executed = executed_;
  return {ReadPlan(source), evaluations_.size()};
}

void Expansion::EvaluateSome(std::size_t begin, std::size_t end) {
  std::vector<Path> asked;
  for (std::size_t i = begin; i < end; ++i) asked.push_back(paths_.PathOf(queue_[i]));
  const std::vector<Evaluation> answers = model_->EvaluateBatch(asked);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const char* defect = Defect(answers.at(i), rules_.num_actions);
    if (*defect != '\0') {
      throw std::runtime_error("the model's evaluation of " + ToString(asked[i]) +
                               " is unsound: " + defect);
    }
    evaluations_.Put(queue_[begin + i], answers[i], 0);
  }
}

bool Expansion::Hopeless(PathId id) const {
  return id != kRoot && (evaluations_.done(id) < parameters_.c_done ||
                         evaluations_.value(id) < parameters_.v_failed);
}

void Expansion::QueueChildren(PathId id) {
  if (paths_.depth(id) >= parameters_.depth || (prune_ && Hopeless(id))) return;
  for (const int action : rules_.AllowedActions(executed_, paths_.PathOf(id))) {
    if (prune_ && evaluations_.p(id)[action] < parameters_.p_min) continue;
    queue_.push_back(paths_.Add(id, action));
  }
}

}  // namespace

ExhaustiveResult ExhaustivePlan(const TaskRules& rules, const SearchParameters& parameters,
                                const Path& executed, ModelSource* model, bool prune, int batch) {
  if (batch < 1) throw std::invalid_argument("a batch holds at least one path");
  rules.Validate();
  parameters.Validate();
  return Expansion(rules, parameters, executed, model, prune).Run(batch);
}

Path GreedyPlan(const TaskRules& rules, const SearchParameters& parameters, const Path& executed,
                ModelSource* model) {
  Path path;
  while (static_cast<int>(path.size()) < parameters.depth) {
    const std::vector<int> actions = rules.AllowedActions(executed, path);
    if (actions.empty()) break;
    const Evaluation seen = AsOnTheWire(model->Evaluate(path));
    int best = -1;
    for (const int action : actions) {
      if (seen.p.at(action) < parameters.p_min) continue;
      if (best < 0 || seen.q.at(action) > seen.q.at(best)) best = action;
    }
    if (best < 0) break;
    path.push_back(static_cast<std::uint8_t>(best));
  }
  return path;
}

Path RandomPlan(const TaskRules& rules, const Path& executed, std::uint64_t seed) {
  Path path;
  for (;;) {
    const std::vector<int> actions = rules.AllowedActions(executed, path);
    if (actions.empty()) return path;
    // The bias of the modulus is below 2^-55.
    const std::uint64_t draw = HashCombine(seed, path.size()) % actions.size();
    path.push_back(static_cast<std::uint8_t>(actions[draw]));
  }
}

Plan PlanOf(const Path& path, const char* reason) {
  Plan plan;
  if (path.empty()) {
    plan.status = PlanStatus::kRefused;
    plan.reason = reason;
    return plan;
  }
  plan.status = PlanStatus::kPlan;
  plan.best.path = path;
  for (const auto action : path) {
    plan.best.steps.emplace_back();
    plan.best.steps.back().action = action;
  }
  return plan;
}

}  // namespace prospect::planner
