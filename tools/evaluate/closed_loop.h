#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/options/scene.h"
#include "cli/options/search.h"
#include "cli/options/shard.h"
#include "model/refusal/scene_kind.h"
#include "planner/search_parameters.h"
#include "sim/task_factory.h"
#include "tools/evaluate/decider.h"
#include "tools/evaluate/scene_draw.h"
#include "tools/evaluate/scene_runs.h"

namespace prospect::tools {

// Closed loops without a bus: the same planner, networks and world as the services, in one process
// a job.
struct ClosedLoop {
  std::string task, weights;  // weights: a file
  sim::TaskOptions world;
  int scenes = 0;  // from `seed` on, unless `wanted` asks for classes
  ScenesWanted wanted;
  std::uint64_t seed = 0;
  Goal goal;  // empty: the task's own
  planner::SearchParameters search;
  int retries = 1;
  double surprise = 0;
  double threshold = -1;  // negative: the weights' own
  double novelty = 0;     // first pictures with a smaller p-value are refused; 0: none
  bool open_loop = false;
  std::vector<std::string> rows;  // planner, nothing, random, greedy, exhaustive, simulator_model,
                                  // samples=N, simulator_model=N
  int jobs = 1;
  std::string videos;  // folder; empty: none
  cli::ShardOptions shard;
};

// What a search and the loop around it are asked for. `goal` is read as loop->task in loop->world
// has it. Throws ExitError (kExitRefusal: it cannot be brought about).
void Ask(const cli::SearchOptions& search, const std::string& goal, ClosedLoop* loop);

// Refuses what no process could do, before any starts. Throws std::invalid_argument, ExitError
// (kExitRefusal: the goal cannot be brought about) or model::WeightsError.
void CheckInputs(const ClosedLoop& loop);

// What kind of scenes they are.
model::SceneKind KindAsked(const ClosedLoop& loop);

// The loop's scenes as items of a run; `weights_hash` says which weights they are run with.
Items ScenesOf(const ClosedLoop& loop, std::uint64_t weights_hash);

// Runs the scenes: all, or the share of loop.shard. Shows progress; is stopped, and throws, as
// RunScenes.
SceneRuns RunClosedLoops(const ClosedLoop& loop, Items scenes);

// The runs as a table for a person, on Words() (tools/common/words.h).
void Tell(const ClosedLoop& loop, const SceneRuns& runs);

// The runs' summary and records, with what they were made with.
nlohmann::json ReportOf(const ClosedLoop& loop, const SceneRuns& runs);

}  // namespace prospect::tools
