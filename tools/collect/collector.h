#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/task_factory.h"

namespace prospect::tools {

// What `prospect-collect` is asked for.
struct CollectOptions {
  std::string task = "navigation";
  int trials = 100;
  std::uint64_t seed = 0;     // trial i has seed + i; all must lie in 0..999,999
  std::string out;            // FILE.h5
  std::string objects = "4";  // a number, or "mixed": drawn for each trial
  std::string legs = "3";     // a number, or "mixed"
  int tower = 2;              // stacking: blocks in the tower, 2 to 4
  std::string scene_file;     // stacking: empty for the built-in scene
  double image_noise = 0.01;  // stored with the trial; the frames stay clean
  int jobs = 2;               // processes
  bool resume = false;        // go on where an earlier, killed run of the same command stopped
  bool keep_parts = false;
};

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
// equal shares.
sim::TaskOptions SceneOptions(const CollectOptions& options, std::uint64_t seed);

// Records all trials, one file each in OUT.parts/, then packs them into OUT and removes the parts.
// Throws CollectUsageError, model::DataError, base::DiskError (also where another process collects
// there), Interrupted.
CollectSummary Collect(const CollectOptions& options);

}  // namespace prospect::tools
