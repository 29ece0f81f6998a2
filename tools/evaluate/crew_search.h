#pragma once

#include "planner/model_source.h"
#include "planner/search.h"

namespace prospect::tools {

// What several workers came to.
struct CrewResult {
  planner::Plan plan;
  std::int64_t rollouts = 0;     // of all
  std::int64_t evaluations = 0;  // distinct paths
};

// parameters.workers workers sharing one tree, inside one process and without a bus: they move in
// turns, one leaf each; what all ask for in a turn is evaluated at once and heard by all, and each
// tells its rows every `turns_per_tick` turns. So each chooses on what it could know over a bus: by
// everybody's evaluations, and by rollouts as of the last tick. A turn stands for 4 ms. Repeatable.
// Throws what the model throws.
CrewResult SearchWithCrew(const planner::TaskRules& rules,
                          const planner::SearchParameters& parameters,
                          const planner::Path& executed, planner::ModelSource* model,
                          int turns_per_tick = 5);

}  // namespace prospect::tools
