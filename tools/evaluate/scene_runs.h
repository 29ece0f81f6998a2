#pragma once

#include <cstdint>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "model/novelty.h"
#include "model/weights_file.h"
#include "tools/common/fork_map.h"
#include "tools/common/progress.h"

namespace prospect::tools {

// A record of one scene, made by whatever a process has set up for many.
using SceneRun = std::function<nlohmann::json(std::uint64_t scene_seed)>;

// Records of the scenes that were run, in the order of their seeds.
struct SceneRuns {
  std::vector<nlohmann::json> records;
  Extent extent;
};

// Runs these scenes in `jobs` processes that each set themselves up once. Shows progress. Throws as
// ForkMap, and is stopped as it is.
inline SceneRuns RunScenes(const std::vector<std::uint64_t>& seeds, int jobs,
                           const std::function<SceneRun()>& set_up) {
  std::vector<nlohmann::json> records(seeds.size());
  const int scenes = static_cast<int>(seeds.size());
  Progress progress("scenes", scenes);
  SceneRuns runs;
  runs.extent = ForkMap(
      scenes, jobs,
      [&]() {
        const SceneRun run = set_up();
        return [run, &seeds](int i) { return run(seeds[static_cast<std::size_t>(i)]).dump(); };
      },
      [&](int i, const std::string& line) {
        records[static_cast<std::size_t>(i)] = nlohmann::json::parse(line);
        progress.Step();
      });
  for (nlohmann::json& record : records) {
    if (!record.is_null()) runs.records.push_back(std::move(record));
  }
  return runs;
}

// The same for the scenes from `first_seed` on.
inline SceneRuns RunScenes(int scenes, std::uint64_t first_seed, int jobs,
                           const std::function<SceneRun()>& set_up) {
  std::vector<std::uint64_t> seeds(static_cast<std::size_t>(scenes));
  std::iota(seeds.begin(), seeds.end(), first_seed);
  return RunScenes(seeds, jobs, set_up);
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
