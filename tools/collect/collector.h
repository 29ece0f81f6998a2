#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "cli/commands/collect.h"
#include "sim/task_factory.h"

namespace prospect::tools {

struct CollectSummary {
  int trials = 0;
  int kept = 0;  // of these, trials that an earlier run had finished
  int successes = 0;
  std::map<std::string, int> failures;  // by cause
  std::int64_t frames = 0;
  double simulated_seconds = 0;
  double wall_seconds = 0;
};

// A bad option; the message says what to give instead.
class CollectUsageError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

// The scene parameters of trial `seed`. "mixed" objects: half of all trials have 4, the others 4 to
// 7 at equal shares; "mixed" legs: 3 with 4 objects in the first half, else 3 to min(5, objects) at
// equal shares. "mixed" towers: 2, 3 or 4 at equal shares.
sim::TaskOptions SceneOptions(const cli::TrialSceneOptions& scenes, std::uint64_t seed);

// Records all trials, or the share of options.shard, one file each in OUT.parts/, then packs them
// into OUT and removes the parts.
// Throws CollectUsageError, model::DataError, base::DiskError (also where another process collects
// there), Interrupted.
CollectSummary Collect(const cli::CollectOptions& options);

}  // namespace prospect::tools
