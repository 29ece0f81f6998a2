#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/random.h"
#include "cli/report_file.h"
#include "model/trial.h"
#include "tools/ceiling/foretold.h"
#include "tools/ceiling/replay.h"
#include "tools/collect/collector.h"
#include "tools/collect/scene_tasks.h"
#include "tools/common/run_items.h"
#include "tools/world/commands.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMomentStream = 0x6d6f6d656e74ULL;

std::vector<std::uint64_t> TestSeeds(const cli::CeilingOptions& options) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = options.seed; static_cast<int>(seeds.size()) < options.trials; ++seed) {
    if (seed > model::kLastCollectionSeed)
      throw std::invalid_argument(
          "so many test trials do not come after that seed: lower --trials");
    if (model::SplitOf(seed) == model::Split::kTest) seeds.push_back(seed);
  }
  return seeds;
}

json ToJson(const Repetitions& r) {
  return {r.first.runs, r.first.came_true, r.second.runs, r.second.came_true};
}

json ToJson(const PictureErrors& e) {
  return e.known ? json{e.foretold, e.in_itself} : json::array();
}

Repetitions FromJson(const json& j) { return {{j[0], j[1]}, {j[2], j[3]}}; }

// Uniform over all moments of all trials: a number is drawn first, and trials that do not last so
// long give none.
json LookAt(sim::Task& task, std::uint64_t seed, int runs, int most) {
  const int number = base::Random(base::MixSeeds({seed, kMomentStream})).Below(most + 1);
  const std::optional<Moment> moment = Replay(task, seed, number, runs);
  if (!moment) return json::object();
  json line = {{"V after one", ToJson(moment->value_one)},
               {"f after one", ToJson(moment->done_one)},
               {"V after two", ToJson(moment->value_two)},
               {"f after two", ToJson(moment->done_two)}};
  line["x1"] = ToJson(moment->pictures_one);
  line["x2"] = ToJson(moment->pictures_two);
  if (number > 0) line["V, real states"] = ToJson(moment->value);
  return line;
}

double ShareOf(const Frequency& f) { return static_cast<double>(f.came_true) / f.runs; }

// What one half foretells of the other: a little less than could be known, since a few runs tell a
// probability only roughly. And all runs of themselves: a little more.
struct Bounds {
  std::vector<Foretold> low, high;

  void Add(const Repetitions& r) {
    if (r.first.runs == 0 || r.second.runs == 0) return;
    const Frequency all{r.first.runs + r.second.runs, r.first.came_true + r.second.came_true};
    low.push_back({ShareOf(r.first), ShareOf(r.second)});
    high.push_back({ShareOf(all), ShareOf(all)});
  }
};

// Of all moments, their mean.
struct PictureBounds {
  int moments = 0;
  double foretold = 0, in_itself = 0;  // sums

  void Add(const json& pair) {
    if (pair.empty()) return;
    ++moments;
    foretold += pair[0].get<double>();
    in_itself += pair[1].get<double>();
  }
};

json Figures(const PictureBounds& bounds) {
  const double n = std::max(1, bounds.moments);
  return {{"moments", bounds.moments},
          {"mean_absolute_error", {bounds.in_itself / n, bounds.foretold / n}}};
}

json Figures(const Bounds& bounds) {
  const Scores low = ScoresOf(bounds.low), high = ScoresOf(bounds.high);
  return {{"moments", high.moments},
          {"base_rate", high.base_rate},
          {"majority", high.majority},
          {"accuracy", {low.accuracy, high.accuracy}},
          {"balanced_accuracy", {low.balanced, high.balanced}},
          {"best_balanced_accuracy", {low.best_balanced, high.best_balanced}},
          {"area_under_roc", {low.area_under_roc, high.area_under_roc}}};
}

void PrintBetween(const json& pair) {
  std::printf("  %.3f to %.3f", pair[0].get<double>(), pair[1].get<double>());
}

void Print(const json& report) {
  std::printf("what can be known of %d moments of %d test trials, by %d repetitions of each\n\n",
              report["moments"].get<int>(), report["trials"].get<int>(), report["runs"].get<int>());
  std::printf("%-16s %7s  %8s  %-14s  %-14s  %-14s  %-14s\n", "", "moments", "majority", "accuracy",
              "balanced", "at its best", "area under ROC");
  for (const auto& [name, row] : report["rows"].items()) {
    std::printf("%-16s %7d  %8.3f", name.c_str(), row["moments"].get<int>(),
                row["majority"].get<double>());
    for (const char* key :
         {"accuracy", "balanced_accuracy", "best_balanced_accuracy", "area_under_roc"}) {
      PrintBetween(row[key]);
    }
    std::printf("\n");
  }
  std::printf("\n%-16s %7s  %-16s\n", "pictures", "moments", "mean abs. error");
  for (const auto& [name, row] : report["pictures"].items()) {
    const json& error = row["mean_absolute_error"];
    std::printf("%-16s %7d  %.4f to %.4f\n", name.c_str(), row["moments"].get<int>(),
                error[0].get<double>(), error[1].get<double>());
  }
}

// No trial has more actions: each begins anew at most once.
int MostActions(const cli::CeilingOptions& options, const std::vector<std::uint64_t>& seeds) {
  SceneTasks tasks(options.task);
  int most = 0;
  for (const std::uint64_t seed : seeds) {
    most = std::max(most, 2 * tasks.Get(SceneOptions(options.scenes, seed)).spec().plan_length);
  }
  return most;
}

// What the records of trials depend on besides the options.
json MadeOf(const cli::CeilingOptions& options, std::uint64_t seed) {
  SceneTasks tasks(options.task);
  return {{"world_version", tasks.Get(SceneOptions(options.scenes, seed)).spec().world_version}};
}

json Report(const cli::CeilingOptions& options, const ItemRuns& runs) {
  std::map<std::string, Bounds> rows;
  std::map<std::string, PictureBounds> pictures;
  int moments = 0;
  for (const json& trial : runs.records) {
    moments += !trial.empty();
    for (const auto& [name, found] : trial.items()) {
      if (name == "x1" || name == "x2")
        pictures[name].Add(found);
      else
        rows[name].Add(FromJson(found));
    }
  }
  json report = {{"task", options.task},   {"trials", runs.extent.done},
                 {"runs", options.runs},   {"moments", moments},
                 {"rows", json::object()}, {"pictures", json::object()}};
  for (const auto& [name, bounds] : rows) report["rows"][name] = Figures(bounds);
  for (const auto& [name, bounds] : pictures) report["pictures"][name] = Figures(bounds);
  runs.extent.Put(&report);
  return report;
}

}  // namespace

int RunCeiling(const cli::CeilingOptions& options) {
  const std::vector<std::uint64_t> seeds = TestSeeds(options);
  const int most = MostActions(options, seeds);  // refuses an unknown task, too
  const auto worker = [&] {
    auto tasks = std::make_shared<SceneTasks>(options.task);
    return [&seeds, &options, tasks, most](int i) {
      const std::uint64_t seed = seeds[static_cast<std::size_t>(i)];
      sim::Task& task = tasks->Get(SceneOptions(options.scenes, seed));
      return LookAt(task, seed, options.runs, most).dump();
    };
  };
  const Items trials = {"trials", options.trials, options.jobs, MadeOf(options, seeds.front())};
  const ItemRuns runs = RunItems(options.shard, trials, worker);
  if (options.shard.given())
    return WritePart(options.shard, options.report, "ceiling", trials, runs);
  const Extent& extent = runs.extent;
  const json report = Report(options, runs);
  if (options.report.talks()) {
    Print(report);
    std::printf("%s", extent.Line("trials").c_str());
  }
  cli::WriteReport(options.report, report);
  return extent.exit_code();
}

}  // namespace prospect::tools
