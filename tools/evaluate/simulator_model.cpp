#include "tools/evaluate/simulator_model.h"

#include <utility>

#include "base/random.h"
#include "sim/rollout.h"

namespace prospect::tools {

SimulatorModel::SimulatorModel(sim::Task* task, std::uint64_t noise_seed, int runs) : task_(task) {
  const std::unique_ptr<sim::TaskState> real = task_->Save();
  Node root;
  for (int run = 0; run < runs; ++run) {
    const auto number = static_cast<std::uint64_t>(run);
    task_->SetNoiseSeed(run == 0 ? noise_seed : base::MixSeeds({noise_seed, number}));
    root.going.push_back(task_->Save());
  }
  const bool failed = task_->progress().outcome == sim::Outcome::kFailure;
  root.evaluation = Judge(failed ? 0 : 1);
  task_->Restore(*real);
  nodes_[{}] = std::move(root);
}

// Of the state that the task is in.
planner::Evaluation SimulatorModel::Judge(double done) const {
  planner::Evaluation evaluation;
  evaluation.value = done > 0 ? 1.f : 0.f;
  evaluation.done = static_cast<float>(done);
  evaluation.q.assign(task_->spec().actions.size(), 0.f);
  if (done > 0) {
    for (const int action : task_->LegalActions()) evaluation.q[action] = 1.f;
  }
  evaluation.p = evaluation.q;
  return evaluation;
}

SimulatorModel::Node& SimulatorModel::Visit(const planner::Path& path) {
  const auto known = nodes_.find(path);
  if (known != nodes_.end()) return known->second;
  const planner::Path before(path.begin(), path.end() - 1);
  const Node& parent = Visit(before);
  Node node;
  for (const auto& state : parent.going) {
    task_->Restore(*state);
    if (!sim::RunAction(*task_, path.back(), nullptr)) continue;
    if (task_->progress().outcome == sim::Outcome::kFailure) continue;
    node.going.push_back(task_->Save());
  }
  if (!node.going.empty()) task_->Restore(*node.going.front());
  const double came = static_cast<double>(parent.going.size());
  node.evaluation = Judge(came > 0 ? static_cast<double>(node.going.size()) / came : 0);
  return nodes_[path] = std::move(node);
}

planner::Evaluation SimulatorModel::Evaluate(const planner::Path& path) {
  const std::unique_ptr<sim::TaskState> real = task_->Save();
  const planner::Evaluation evaluation = Visit(path).evaluation;
  task_->Restore(*real);
  return evaluation;
}

}  // namespace prospect::tools
