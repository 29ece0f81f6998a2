#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "planner/model_source.h"
#include "sim/task.h"

namespace prospect::tools {

// The simulator itself as the planner's model: what a search could do with perfect imagination. It
// separates a bad model from a bad search. Each action is carried out once, with noise of its own
// (not the episode's). The task is left as it was found after every call. Not thread safe.
class SimulatorModel : public planner::ModelSource {
 public:
  // `task` outlives this. `noise_seed`: of the imagined runs.
  SimulatorModel(sim::Task* task, std::uint64_t noise_seed);

  // V: 1 unless the trial failed; f: the last action succeeded; Q: 1 where legal; p: 1 where legal,
  // else 0.
  planner::Evaluation Evaluate(const planner::Path& path) override;

 private:
  struct Node {
    std::unique_ptr<sim::TaskState> state;
    planner::Evaluation evaluation;
  };
  Node& Visit(const planner::Path& path);
  planner::Evaluation Judge() const;

  sim::Task* task_;
  std::map<planner::Path, Node> nodes_;
};

}  // namespace prospect::tools
