// Several ways of searching, compared on the same trees: each arm runs the discrete-event
// simulation (tools/bench/simulated_bus.h) for the same seeds, and is set beside the first one by
// paired bootstrap over seeds.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/bench/simulated_bus.h"

namespace prospect::tools {

struct Arm {
  std::string name;
  BusOptions options;
};

// "workers=8,sharing=0,drop=0.3" on top of `defaults`. Keys: workers, leaves, samples, sharing (0:
// each worker in a tree of its own), rule, fixed (ms a batch), row (ms), drop, repeat, delay (ms),
// jitter (ms), tick (ms), c, c_puct. Throws std::invalid_argument naming what is wrong.
Arm ParseArm(const std::string& text, const BusOptions& defaults);

// One row for each arm: name, workers, rollouts_per_s, evaluations_per_s, mean_batch, optimal_rate
// and regret with 95 % intervals, against_first (ratios of both, with intervals), bytes and
// microseconds of statistics a rollout, fresh, busy shares, bottleneck. `seeds` >= 1 trees from
// `first_seed` on, `threads` at once.
nlohmann::json RunArms(const std::vector<Arm>& arms, int first_seed, int seeds, int threads);

// The rows as a table for people.
void PrintArms(const nlohmann::json& rows);
// The rows as comma-separated values, a line each.
std::string ArmsAsCsv(const nlohmann::json& rows);

}  // namespace prospect::tools
