// Planner workers around one batching server, as discrete events on a virtual clock: what sharing,
// batching and a bad network do to a search, apart from the speed of the machine that measures it,
// and with more workers than it has processors. The workers are the real planner::Search; the tree
// is planner::ScriptedTree. Repeatable: the same options give the same result, timings aside.
//
//   server   takes what is queued, up to max_batch, and needs fixed_us + row_us a row; while
//   clients
//            that were just answered are due back it waits, at most regroup_us; answers to all
//   workers  one thread each: a rollout, an evaluation heard and a message merged take cpu time,
//   and
//            what arrives meanwhile waits
//   bus      every message reaches everybody delay_us later, or up to jitter_us more (which also
//            reorders); statistics are lost at each receiver, and repeated, at the given rates
#pragma once

#include <cstdint>
#include <string>

#include "planner/search_parameters.h"

namespace prospect::tools {

struct BusOptions {
  planner::SearchParameters parameters;  // samples: of all workers together
  int workers = 1;
  int leaves = 2;          // rollouts a worker keeps in flight
  std::uint64_t seed = 0;  // of the tree, the search and the network
  std::int64_t fixed_us = 4000;
  std::int64_t row_us = 20;
  int max_batch = 16;
  std::int64_t regroup_us = 700;
  std::int64_t tick_us = 40'000;
  std::size_t tick_bytes = 8192;
  std::int64_t delay_us = 200;
  std::int64_t jitter_us = 100;
  double drop = 0;
  double repeat = 0;
  // What a worker's thread needs, microseconds (measured: prospect bench overhead).
  double rollout_us = 8;
  double heard_us = 1;
  double message_us = 10;
  double row_merge_us = 0.3;
  // The bus, bytes a second: one gigabit.
  double bus_bytes_per_s = 125e6;
};

struct BusResult {
  std::int64_t rollouts = 0;  // of all workers
  std::int64_t evaluations = 0;
  std::int64_t batches = 0;
  std::int64_t simulated_us = 0;
  bool optimal = false;  // the plan read off is the best there is
  double regret = 0;     // by how much it is worse
  bool exact = true;  // after two rounds without loss all tables were equal, and held all rollouts
  double statistics_bytes = 0;  // of steady ticks, all workers
  double statistics_us = 0;     // processor time for making, packing, unpacking and merging them
  double fresh = 1;  // of visits to the top three levels 100 ms ago, the part that all workers know
  // Busy shares of the run, 0 to 1.
  double server_busy = 0;
  double worker_busy = 0;  // of the busiest
  double bus_busy = 0;
  std::string Bottleneck() const;
};

BusResult SimulateBus(const BusOptions& options);

}  // namespace prospect::tools
