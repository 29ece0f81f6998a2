#include "tools/collect/collector.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "base/json_file.h"
#include "base/lock.h"
#include "base/random.h"
#include "base/seconds_since.h"
#include "model/dataset.h"
#include "tools/collect/scene_tasks.h"
#include "tools/collect/trial_recorder.h"
#include "tools/common/fork_map.h"
#include "tools/common/parts.h"
#include "tools/common/progress.h"

namespace prospect::tools {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::uint64_t kSceneStream = 0x6d69786564ULL;
constexpr std::uint64_t kTowerStream = 0x746f776572ULL;
constexpr char kMixed[] = "mixed";
constexpr char kCommand[] = "collect";

std::string PartsFolder(const cli::CollectOptions& options) { return options.out + ".parts"; }

std::string PartPath(const cli::CollectOptions& options, std::uint64_t seed) {
  return PartsFolder(options) + "/trial_" + std::to_string(seed) + ".h5";
}

int TrialsOf(const cli::CollectOptions& options) { return options.trials.value_or(100); }

// Of the trials that this process makes.
std::vector<std::uint64_t> SeedsOf(const cli::CollectOptions& options) {
  std::vector<std::uint64_t> seeds;
  for (const int i : ItemsOf(options.shard, TrialsOf(options)))
    seeds.push_back(options.seed + static_cast<std::uint64_t>(i));
  return seeds;
}

sim::TaskOptions SceneOf(const cli::CollectOptions& options, std::uint64_t seed) {
  sim::TaskOptions scene = SceneOptions(options.scenes, seed);
  scene.image_noise = options.image_noise;
  return scene;
}

int NumberOrRefuse(const std::string& name, const std::string& text) {
  if (text.size() == 1 && text[0] >= '0' && text[0] <= '9') return text[0] - '0';
  throw CollectUsageError("--" + name + " is '" + text + "': give a number or " + kMixed);
}

void CheckSeeds(const cli::CollectOptions& options) {
  const std::uint64_t last = options.seed + static_cast<std::uint64_t>(TrialsOf(options)) - 1;
  if (TrialsOf(options) < 1 || options.seed > model::kLastCollectionSeed ||
      last > model::kLastCollectionSeed) {
    throw CollectUsageError("trials have seeds " + std::to_string(options.seed) + " to " +
                            std::to_string(last) +
                            ": collection takes 0 to 999,999, later ones are kept for evaluation");
  }
}

// Refuses a bad task or scene before any process starts.
std::string CheckedWorldVersion(const cli::CollectOptions& options) {
  try {
    return sim::MakeTask(options.task, SceneOf(options, options.seed))->spec().world_version;
  } catch (const std::invalid_argument& error) {
    throw CollectUsageError(error.what());
  }
}

// What the parts of one folder have in common.
json Manifest(const cli::CollectOptions& options) {
  return {{"task", options.task},
          {"world_version", CheckedWorldVersion(options)},
          {"objects", options.scenes.objects},
          {"legs", options.scenes.legs},
          {"tower", options.scenes.tower},
          {"image_noise", options.image_noise},
          {"foresight", options.foresight}};
}

void PrepareParts(const cli::CollectOptions& options) {
  const fs::path folder = PartsFolder(options);
  const fs::path manifest_path = folder / "manifest.json";
  const json manifest = Manifest(options);
  if (fs::exists(manifest_path)) {
    if (!options.resume) {
      throw CollectUsageError(folder.string() +
                              " holds trials of an earlier run: give --resume to go on "
                              "with them, or remove the folder");
    }
    std::ifstream file(manifest_path);
    if (json::parse(file, nullptr, false) != manifest) {
      throw CollectUsageError(folder.string() +
                              " was begun with other options or another world: remove it");
    }
    return;
  }
  base::WriteJsonFile(manifest_path.string(), manifest);
}

json Line(const model::Trial& trial, bool kept) {
  return {{"success", trial.succeeded()},
          {"reason", trial.reason},
          {"frames", trial.frames()},
          {"seconds", (trial.frames() - 1) * trial.tick_seconds},
          {"kept", kept}};
}

json CollectOne(const cli::CollectOptions& options, std::uint64_t seed, SceneTasks* tasks) {
  const std::string path = PartPath(options, seed);
  if (fs::exists(path) && model::IsWholeTrialFile(path)) {
    return Line(model::TrialFile(path).ReadLabels(0), true);
  }
  const model::Trial trial = RecordRandomTrial(tasks->Get(SceneOf(options, seed)), seed,
                                               options.image_noise, options.foresight);
  model::WriteTrialFile(path, trial);
  return Line(trial, false);
}

std::function<std::string(int)> MakeWorker(const cli::CollectOptions& options,
                                           const std::vector<std::uint64_t>& seeds) {
  auto tasks = std::make_shared<SceneTasks>(options.task);
  return [options, tasks, &seeds](int i) {
    return CollectOne(options, seeds[static_cast<std::size_t>(i)], tasks.get()).dump();
  };
}

void Add(const json& line, CollectSummary* summary) {
  ++summary->trials;
  summary->kept += line.at("kept").get<bool>();
  summary->frames += line.at("frames").get<int>();
  summary->simulated_seconds += line.at("seconds").get<double>();
  if (line.at("success").get<bool>()) {
    ++summary->successes;
  } else {
    ++summary->failures[line.at("reason")];
  }
}

std::string SuccessShare(const CollectSummary& summary) {
  return std::to_string((100 * summary.successes + summary.trials / 2) / summary.trials) +
         " % succeeded";
}

void Pack(const cli::CollectOptions& options, const std::vector<std::uint64_t>& seeds) {
  std::vector<std::string> parts;
  for (const std::uint64_t seed : seeds) parts.push_back(PartPath(options, seed));
  model::PackChoice all;
  if (options.shard.given()) {
    const json made_of = {{"world_version", CheckedWorldVersion(options)}};
    all.shard = ToJson(PartOf(options.shard, kCommand, TrialsOf(options), made_of)).dump();
  }
  model::PackTrialFiles(parts, options.out, all);
  if (!options.keep_parts) fs::remove_all(PartsFolder(options));
}

}  // namespace

sim::TaskOptions SceneOptions(const cli::TrialSceneOptions& scenes, std::uint64_t seed) {
  base::Random random(base::MixSeeds({seed, kSceneStream}));
  const bool plain = random.Uniform() < 0.5;
  const int any_objects = 4 + random.Below(4);
  sim::TaskOptions scene;
  scene.tower = scenes.tower == kMixed
                    ? 2 + base::Random(base::MixSeeds({seed, kTowerStream})).Below(3)
                    : NumberOrRefuse("tower", scenes.tower);
  scene.scene_file = scenes.scene_file;
  scene.objects = scenes.objects != kMixed ? NumberOrRefuse("objects", scenes.objects)
                                           : (plain ? 4 : any_objects);
  if (scenes.legs != kMixed) {
    scene.legs = NumberOrRefuse("legs", scenes.legs);
    if (scenes.objects == kMixed) scene.objects = std::max(scene.objects, scene.legs);
  } else if (!plain) {
    scene.legs = 3 + random.Below(std::min(5, scene.objects) - 2);
  }
  return scene;
}

CollectSummary Collect(const cli::CollectOptions& options) {
  CheckSeeds(options);
  CheckedWorldVersion(options);  // before anything is written
  const std::vector<std::uint64_t> seeds = SeedsOf(options);
  const base::Lock own = base::LockFolder(PartsFolder(options));
  PrepareParts(options);
  CollectSummary summary;
  const int trials = static_cast<int>(seeds.size());
  Progress progress("trials", trials);
  const auto start = std::chrono::steady_clock::now();
  const Extent extent = ForkMap(
      trials, options.jobs, [&] { return MakeWorker(options, seeds); },
      [&](int, const std::string& line) {
        Add(json::parse(line), &summary);
        progress.Step(SuccessShare(summary));
      });
  if (extent.stopped()) throw Interrupted(extent.Words("trials") + "; --resume goes on with them");
  Pack(options, seeds);
  summary.wall_seconds = base::SecondsSince(start);
  return summary;
}

}  // namespace prospect::tools
