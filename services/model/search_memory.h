#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <unordered_map>
#include <vector>

#include "lcmtypes/messages.h"
#include "model/engine.h"
#include "planner/evaluation.h"
#include "planner/path.h"
#include "planner/task_rules.h"

namespace prospect::services {

/// What a server holds of one search: the encoded root, the hidden state of each path imagined so
/// far, and its evaluation. Hidden states live within a byte budget, the least recently used go
/// first, and are computed again from the root along the path when they are wanted; evaluations are
/// small and stay. One thread; the engine must outlive it.
class SearchMemory {
 public:
  /// @param executed actions already carried out before this root; the last one is a at the root
  /// @param cache_bytes budget for hidden states; one batch's states are held beyond it while it
  /// runs
  SearchMemory(model::Engine& engine, planner::TaskRules rules, planner::Path executed,
               std::size_t cache_bytes);

  /// The encoded pictures: the episode's first (x0) and the present one (x).
  void SetRoot(model::Hidden first, model::Hidden present);
  bool ready() const { return !first_.empty(); }

  /// Whether the task's rules allow this path from the root.
  bool Legal(const planner::Path& path) const { return rules_.Legal(executed_, path); }

  bool Knows(const planner::Path& path) const { return evaluations_.contains(path); }

  /// Evaluates legal paths, states on the way included where they are missing, in batches of at
  /// most `batch` rows. Needs ready(). Returns the rows computed.
  int Compute(const std::vector<planner::Path>& paths, int batch);

  /// Needs Knows(path).
  const evaluation_t& Evaluation(const planner::Path& path) const { return evaluations_.at(path); }

  /// The hidden state of a legal path, computed if need be. Needs ready().
  model::Hidden State(const planner::Path& path);

  std::size_t hidden_bytes() const { return hidden_bytes_; }
  std::size_t known() const { return evaluations_.size(); }

 private:
  using SharedHidden = std::shared_ptr<const model::Hidden>;
  struct Kept {
    SharedHidden hidden;
    std::list<planner::Path>::iterator use;  // in uses_
  };
  using PathSet = std::vector<planner::Path>;

  SharedHidden Find(const planner::Path& path);
  void Keep(const planner::Path& path, SharedHidden hidden);
  void Evict();
  void Store(const planner::Path& path, model::Prediction prediction);
  std::vector<PathSet> MissingInWaves(const std::vector<planner::Path>& paths, bool states_too);
  int ComputeMissing(const std::vector<planner::Path>& paths, bool states_too, int batch);
  void ComputeRows(const PathSet& paths, std::size_t begin, std::size_t end);
  void ComputeRoot();

  model::Engine& engine_;
  planner::TaskRules rules_;
  planner::Path executed_;
  std::size_t cache_bytes_;
  model::Hidden first_;
  model::Hidden present_;
  std::unordered_map<planner::Path, evaluation_t, planner::PathHash> evaluations_;
  std::unordered_map<planner::Path, Kept, planner::PathHash> kept_;
  std::list<planner::Path> uses_;  // most recent first
  std::size_t hidden_bytes_ = 0;
  // States of the computation that runs: they must not be evicted under it.
  std::unordered_map<planner::Path, SharedHidden, planner::PathHash> pinned_;
};

}  // namespace prospect::services
