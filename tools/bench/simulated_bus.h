// Planner workers around one batching server in simulated time: what sharing and batching give,
// apart from the speed of the machine that measures it. The server takes all that is queued, up to
// max_batch, and needs fixed_us + row_us a row; replies reach every worker at once; workers think
// in no time and exchange statistics every tick. Repeatable: the same options give the same result.
#pragma once

#include <cstdint>

#include "planner/search_parameters.h"
#include "planner/task_rules.h"

namespace prospect::tools {

struct BusOptions {
  planner::TaskRules rules;
  planner::SearchParameters parameters;  // samples: of all workers together
  int workers = 1;
  int leaves = 2;  // rollouts a worker keeps in flight
  std::uint64_t seed = 0;
  std::int64_t fixed_us = 4000;
  std::int64_t row_us = 20;
  int max_batch = 16;
  std::int64_t tick_us = 20'000;
  std::size_t tick_bytes = 8000;
};

struct BusResult {
  std::int64_t rollouts = 0;
  std::int64_t evaluations = 0;
  std::int64_t batches = 0;
  std::int64_t simulated_us = 0;
  double score = 0;  // of the plan read off, 0 for a refusal
};

BusResult SimulateBus(const BusOptions& options);

}  // namespace prospect::tools
