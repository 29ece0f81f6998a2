#include "tools/evaluate/simulator_model.h"

#include "sim/rollout.h"

namespace prospect::tools {

SimulatorModel::SimulatorModel(sim::Task* task, std::uint64_t noise_seed) : task_(task) {
  const std::unique_ptr<sim::TaskState> real = task_->Save();
  task_->SetNoiseSeed(noise_seed);
  nodes_[{}] = Node{task_->Save(), Judge()};
  task_->Restore(*real);
}

planner::Evaluation SimulatorModel::Judge() const {
  const sim::Progress progress = task_->progress();
  const bool failed = progress.outcome == sim::Outcome::kFailure;
  planner::Evaluation evaluation;
  evaluation.value = failed ? 0.f : 1.f;
  evaluation.done = failed ? 0.f : 1.f;
  evaluation.q.assign(task_->spec().actions.size(), 0.f);
  for (int action : task_->LegalActions()) evaluation.q[action] = 1.f;
  evaluation.p = evaluation.q;
  return evaluation;
}

SimulatorModel::Node& SimulatorModel::Visit(const planner::Path& path) {
  const auto known = nodes_.find(path);
  if (known != nodes_.end()) return known->second;
  planner::Path parent(path.begin(), path.end() - 1);
  task_->Restore(*Visit(parent).state);
  const bool legal = sim::RunAction(*task_, path.back(), nullptr);
  Node node{task_->Save(), Judge()};
  if (!legal) node.evaluation.value = node.evaluation.done = 0.f;
  return nodes_[path] = std::move(node);
}

planner::Evaluation SimulatorModel::Evaluate(const planner::Path& path) {
  const std::unique_ptr<sim::TaskState> real = task_->Save();
  const planner::Evaluation evaluation = Visit(path).evaluation;
  task_->Restore(*real);
  return evaluation;
}

}  // namespace prospect::tools
