#pragma once

#include <cstdint>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "base/hash.h"
#include "model/novelty.h"
#include "model/weights_file.h"
#include "sim/task_factory.h"
#include "tools/common/run_items.h"

namespace prospect::tools {

// A record of one scene, made by whatever a process has set up for many.
using SceneRun = std::function<nlohmann::json(std::uint64_t scene_seed)>;

// Records of the scenes that were run, in the order of their seeds.
using SceneRuns = ItemRuns;

// What the records of these scenes depend on besides the options. Throws as sim::MakeTask,
// model::WeightsError.
inline nlohmann::json SceneSource(const std::string& task, const sim::TaskOptions& world,
                                  std::uint64_t weights_hash) {
  return {{"world_version", sim::MakeTask(task, world)->spec().world_version},
          {"weights", base::HexText(weights_hash)}};
}

// Runs these scenes, which are all `items` of a run, or the share of `shard`, in items.jobs
// processes that each set themselves up once. Shows progress. Throws, and is stopped, as RunItems.
inline SceneRuns RunScenes(const cli::ShardOptions& shard, const Items& items,
                           const std::vector<std::uint64_t>& seeds,
                           const std::function<SceneRun()>& set_up) {
  return RunItems(shard, items, [&]() {
    const SceneRun run = set_up();
    return [run, &seeds](int i) { return run(seeds[static_cast<std::size_t>(i)]).dump(); };
  });
}

// The same for the scenes from `first_seed` on.
inline SceneRuns RunScenes(const cli::ShardOptions& shard, const Items& items,
                           std::uint64_t first_seed, const std::function<SceneRun()>& set_up) {
  std::vector<std::uint64_t> seeds(static_cast<std::size_t>(items.count));
  std::iota(seeds.begin(), seeds.end(), first_seed);
  return RunScenes(shard, items, seeds, set_up);
}

// Throws model::WeightsError when the file cannot be read or was trained for another task.
inline void RequireWeightsOf(const std::string& task, const std::string& weights) {
  const std::string made_for = model::ReadWeights(weights).metadata.value("task", std::string());
  if (made_for == task) return;
  throw model::WeightsError(weights + ": was trained for task '" + made_for + "', not for '" +
                            task + "': give --weights of that task");
}

// Tells on standard error where the weights hold nothing of known pictures.
inline void WarnWithoutNovelty(const std::string& weights) {
  if (model::NoveltyGauge::Load(weights)) return;
  std::cerr << weights
            << " holds nothing of known pictures: none is refused as unlike them (./prospect "
               "evaluate novelty)\n";
}

}  // namespace prospect::tools
