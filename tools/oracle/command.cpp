#include <chrono>
#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "base/seconds_since.h"
#include "cli/report_file.h"
#include "sim/oracle_cache.h"
#include "sim/task_factory.h"
#include "tools/common/interval.h"
#include "tools/common/run_items.h"
#include "tools/common/world.h"
#include "tools/oracle/speed.h"
#include "tools/world/commands.h"

namespace prospect::tools {
namespace {

using nlohmann::json;
using Options = cli::OracleOptions;

// One scene's line from a worker.
json Consult(sim::Task& task, std::uint64_t seed, sim::OracleCache* cache) {
  const auto start = std::chrono::steady_clock::now();
  task.Reset(seed);
  const sim::OracleResult result = cache != nullptr ? sim::ConsultOracleCached(task, seed, *cache)
                                                    : sim::ConsultOracle(task, seed);
  return {{"class", sim::ToString(result.scene_class)},
          {"failure_share", result.random_failure_share()},
          {"runs", static_cast<int>(result.plans.size()) * result.rounds},
          {"plans", result.plans.size()},
          {"frequency", result.success_frequency()},
          {"failures", result.failures},
          {"seconds", base::SecondsSince(start)}};
}

struct Totals {
  int scenes = 0;
  double seconds = 0;             // summed over scenes
  double failure_share = 0;       // summed over scenes
  double solvable_frequency = 0;  // summed over solvable scenes
  std::map<std::string, int> classes = {{"solvable", 0}, {"hopeless", 0}, {"doubtful", 0}};
  std::map<std::string, double> causes;  // reason -> share of all random runs, summed over scenes
};

void Add(const json& scene, Totals* totals) {
  ++totals->scenes;
  totals->seconds += scene.at("seconds").get<double>();
  totals->failure_share += scene.at("failure_share").get<double>();
  const std::string scene_class = scene.at("class");
  ++totals->classes[scene_class];
  if (scene_class == "solvable") totals->solvable_frequency += scene.at("frequency").get<double>();
  const double runs = scene.at("runs");
  for (const auto& [reason, count] : scene.at("failures").items()) {
    totals->causes[reason] += count.get<double>() / runs;
  }
}

// Keys: task, scenes, first_seed, objects, legs, random_failure_share, causes (reason: share of all
// random runs), solvable, hopeless, doubtful (count, share, low, high), oracle_success,
// seconds_per_scene, times_real_time, times_real_time_camera, stopped, wanted (scenes).
json Report(const Options& options, const Totals& totals) {
  const sim::TaskOptions world = WorldOf(options.scene);
  json report = {{"task", options.task},
                 {"scenes", totals.scenes},
                 {"first_seed", options.seed},
                 {"objects", world.objects},
                 {"legs", world.legs},
                 {"random_failure_share", totals.failure_share / totals.scenes},
                 {"seconds_per_scene", totals.seconds / totals.scenes}};
  for (const auto& [name, count] : totals.classes) {
    const Share share = ShareOf(count, totals.scenes);
    report[name] = {
        {"count", count}, {"share", share.value}, {"low", share.low}, {"high", share.high}};
  }
  const int solvable = totals.classes.at("solvable");
  report["oracle_success"] = solvable > 0 ? totals.solvable_frequency / solvable : 0.0;
  json causes = json::object();
  for (const auto& [reason, sum] : totals.causes) causes[reason] = sum / totals.scenes;
  report["causes"] = causes;
  const std::unique_ptr<sim::Task> task = sim::MakeTask(options.task, world);
  report["times_real_time"] = TimesRealTime(*task, options.seed, false);
  report["times_real_time_camera"] = TimesRealTime(*task, options.seed, true);
  return report;
}

void Print(const json& report) {
  std::printf("scenes %d, objects %d, legs %d, first seed %llu\n", report["scenes"].get<int>(),
              report["objects"].get<int>(), report["legs"].get<int>(),
              report["first_seed"].get<unsigned long long>());
  std::printf("random orders that fail  %5.1f %%\n",
              100 * report["random_failure_share"].get<double>());
  for (const auto& [reason, share] : report["causes"].items()) {
    std::printf("  %-22s %5.1f %%\n", reason.c_str(), 100 * share.get<double>());
  }
  for (const char* name : {"solvable", "hopeless", "doubtful"}) {
    const json& row = report[name];
    std::printf("%-24s %5.1f %%  (%.1f to %.1f, %d scenes)\n", name,
                100 * row["share"].get<double>(), 100 * row["low"].get<double>(),
                100 * row["high"].get<double>(), row["count"].get<int>());
  }
  std::printf("oracle's success on solvable scenes  %.1f %%\n",
              100 * report["oracle_success"].get<double>());
  std::printf(
      "%.3f s a scene and process; %.0f times real time on one core, %.0f with the camera\n",
      report["seconds_per_scene"].get<double>(), report["times_real_time"].get<double>(),
      report["times_real_time_camera"].get<double>());
}

std::function<std::string(int)> MakeWorker(const Options& options) {
  const sim::TaskOptions world = WorldOf(options.scene);
  auto task = std::shared_ptr<sim::Task>(sim::MakeTask(options.task, world));
  std::shared_ptr<sim::OracleCache> cache;
  if (!options.fresh) {
    const sim::OracleKey key = sim::OracleKeyOf(*task, world.objects);
    cache = std::make_shared<sim::OracleCache>(key, options.cache);
  }
  const std::uint64_t seed = options.seed;
  return [task, cache, seed](int i) { return Consult(*task, seed + i, cache.get()).dump(); };
}

}  // namespace

int RunOracle(const Options& options) {
  // Refuses bad options before any process starts.
  const auto task = sim::MakeTask(options.task, WorldOf(options.scene));
  const Items scenes = {
      "scenes", options.scenes, options.jobs, {{"world_version", task->spec().world_version}}};
  const ItemRuns runs = RunItems(options.shard, scenes, [&] { return MakeWorker(options); });
  if (options.shard.given())
    return WritePart(options.shard, options.report, "oracle", scenes, runs);
  const Extent& extent = runs.extent;
  if (runs.records.empty()) throw Interrupted(extent.Words("scenes"));
  Totals totals;
  for (const json& scene : runs.records) Add(scene, &totals);
  json report = Report(options, totals);
  extent.Put(&report);
  if (options.report.talks()) {
    Print(report);
    std::printf("%s", extent.Line("scenes").c_str());
  }
  cli::WriteReport(options.report, report);
  return extent.exit_code();
}

}  // namespace prospect::tools
