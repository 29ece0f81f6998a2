// Drives a search inside one process, with a model that answers at once: what tools and tests use.
#pragma once

#include <cstdint>
#include <vector>

#include "planner/search.h"

namespace prospect::planner {

// Whoever can evaluate paths from one root. Implementations say whether they are thread safe.
class ModelSource {
 public:
  virtual ~ModelSource() = default;
  // V, f, Q, p of the node that `path` leads to; must be a function of the path. May throw.
  virtual Evaluation Evaluate(const Path& path) = 0;
  // Several at once, in order; override where a batch is cheaper.
  virtual std::vector<Evaluation> EvaluateBatch(const std::vector<Path>& paths);
};

// Runs `search` until it is done and nothing is in flight, with up to `leaves` paths in each batch
// (>= 1). Time stands still: deadlines do not apply. Throws what the model throws, and
// std::runtime_error if an evaluation is refused, or the search waits for other live workers' rows.
void RunSearch(Search* search, ModelSource* model, int leaves = 1);

}  // namespace prospect::planner
