#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "planner/model_source.h"
#include "sim/task.h"

namespace prospect::tools {

// The simulator itself as the planner's model: what a search could do with perfect imagination. It
// separates a bad model from a bad search. Each action is carried out in several runs, with noise
// of their own (none of it the episode's), which go on for as long as they do not fail: one run
// alone would call every lucky plan a good one, and a search finds the luckiest. The task is left
// as it was found after every call. Not thread safe.
class SimulatorModel : public planner::ModelSource {
 public:
  // `task` outlives this. `noise_seed`: of the imagined runs. `runs`: how many, at least 1.
  SimulatorModel(sim::Task* task, std::uint64_t noise_seed, int runs);

  // V: 1 unless all runs failed; f: the share of the runs that came here which the last action did
  // not fail; Q: 1 where legal; p: 1 where legal, else 0.
  planner::Evaluation Evaluate(const planner::Path& path) override;

 private:
  struct Node {
    std::vector<std::unique_ptr<sim::TaskState>> going;  // a state for each run that has not failed
    planner::Evaluation evaluation;
  };
  Node& Visit(const planner::Path& path);
  planner::Evaluation Judge(double done) const;

  sim::Task* task_;
  std::map<planner::Path, Node> nodes_;
};

}  // namespace prospect::tools
