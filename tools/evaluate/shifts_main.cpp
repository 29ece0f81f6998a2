// prospect-evaluate-shifts: what a planner does when pictures are not like those it was trained on:
// light, camera angle, colours and noise at five strengths each, open loop. Needs no bus.

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "base/json_file.h"
#include "base/lock.h"
#include "model/weights.h"
#include "report/shift_plot.h"
#include "tools/common/fork_map.h"
#include "tools/common/progress.h"
#include "tools/common/scene_options.h"
#include "tools/common/torch_main.h"
#include "tools/evaluate/calibrate.h"
#include "tools/evaluate/record_file.h"
#include "tools/evaluate/scene_runs.h"
#include "tools/evaluate/shift_sweep.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

struct Options {
  SweepOptions sweep;
  std::vector<std::string> factors = sim::ShiftFactors();
  std::string out, json_file;
  std::uint64_t seed = 2'000'300;
  int scenes = 100, jobs = 2;
  double threshold = -1;
};

void AddOptions(CLI::App* app, Options* o) {
  SweepOptions& sweep = o->sweep;
  app->add_flag("--shifts")->description("This program: shifted pictures instead of closed loops");
  app->add_option("--task", sweep.task, "Task")->capture_default_str();
  app->add_option("--weights", sweep.weights, "Weights file")->required();
  app->add_option("--factors", o->factors, "Which of light, camera, colour, noise")
      ->delimiter(',')
      ->capture_default_str();
  app->add_option("--scenes", o->scenes, "Scenes of each point: all, in seed order")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app->add_option("--seed", o->seed, "First scene; 1000000 and up")
      ->check(CLI::Range(std::uint64_t{1'000'000}, std::uint64_t{1} << 40))
      ->capture_default_str();
  AddSceneOptions(app, &sweep.world);
  app->add_option("--samples", sweep.search.samples, "Rollouts a search")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app->add_option("--novelty", sweep.novelty_level,
                  "Pictures with a smaller p-value are refused as unlike the known ones; 0: none")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app->add_option("--threshold", o->threshold,
                  "Plan score below which to refuse; negative: the weights' own")
      ->capture_default_str();
  app->add_option("--jobs", o->jobs, "Processes")->check(CLI::Range(1, 64))->capture_default_str();
  app->add_option("--out", o->out,
                  "Folder for shifts.png and the records, from which the same command goes on "
                  "after an interruption; default out/shifts-TASK");
  app->add_option("--json", o->json_file, "Also write the figures and a record a scene here");
}

// What the records of scenes depend on.
json KeyOf(const Options& o) {
  const SweepOptions& sweep = o.sweep;
  return {{"task", sweep.task},
          {"weights", std::to_string(model::WeightsFileHash(sweep.weights))},
          {"factors", o.factors},
          {"objects", sweep.world.objects},
          {"legs", sweep.world.legs},
          {"tower", sweep.world.tower},
          {"scene_file", sweep.world.scene_file},
          {"samples", sweep.search.samples},
          {"v_failed", sweep.search.v_failed},
          {"novelty", sweep.novelty_level},
          {"threshold", sweep.search.refusal_threshold}};
}

void Prepare(Options* options) {
  SweepOptions& sweep = options->sweep;
  sweep.points = ShiftPoints(options->factors);
  const auto task = sim::MakeTask(sweep.task, sweep.world);  // refuses what is out of range
  task->Reset(options->seed);
  RequireWeightsOf(sweep.task, sweep.weights);
  HeedCoverage(sweep.weights, KindOf(*task), &options->threshold);
  sweep.search.refusal_threshold = options->threshold;
  if (options->threshold < 0) {
    sweep.search.refusal_threshold =
        model::LoadTorchEngine(sweep.weights, 1)->info().refusal_threshold;
  }
  if (options->out.empty()) options->out = "out/shifts-" + sweep.task;
  if (!model::NoveltyGauge::Load(sweep.weights)) {
    std::cerr << "prospect-evaluate-shifts: " << sweep.weights
              << " holds nothing of known pictures: none is refused as unlike them "
                 "(--calibrate-novelty)\n";
  }
}

// Of the scenes that have none yet; each is on disk as soon as it is made.
void MakeMissing(const Options& options, RecordFile* file) {
  std::vector<std::uint64_t> missing;
  for (int i = 0; i < options.scenes; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    if (file->records().count(seed) == 0) missing.push_back(seed);
  }
  if (missing.empty()) return;
  const int scenes = static_cast<int>(missing.size());
  Progress progress("scenes", scenes);
  // What is missing after a stop is seen by what the file holds.
  [[maybe_unused]] const Extent made = ForkMap(
      scenes, options.jobs,
      [&]() {
        auto sweep = std::make_shared<ShiftSweep>(options.sweep);
        return [sweep, &missing](int i) {
          return sweep->Run(missing[static_cast<std::size_t>(i)]).dump();
        };
      },
      [&](int, const std::string& line) {
        file->Store(json::parse(line));
        progress.Step();
      });
}

int Main(int argc, char** argv) {
  Options options;
  options.sweep.search.samples = 30;
  CLI::App app("Open loop with pictures unlike those the networks were trained on");
  AddOptions(&app, &options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  Prepare(&options);
  const base::Lock own = base::LockFolder(options.out);
  RecordFile file(options.out + "/records.jsonl", KeyOf(options));
  MakeMissing(options, &file);
  std::vector<json> scenes;
  for (int i = 0; i < options.scenes; ++i) {
    const auto found = file.records().find(options.seed + static_cast<std::uint64_t>(i));
    if (found != file.records().end()) scenes.push_back(found->second);
  }
  const Extent extent{static_cast<int>(scenes.size()), options.scenes};
  json summary = SummariseShifts(scenes, options.sweep.points);
  std::cout << ShiftTable(summary) << extent.Line("scenes");
  const std::string plot = options.out + "/shifts.png";
  report::WriteShiftPlot(plot, summary, "Pictures unlike the known ones: " + options.sweep.task);
  std::cout << "plot: " << plot << "\n";
  if (options.json_file.empty()) return extent.exit_code();
  summary["task"] = options.sweep.task;
  summary["first_seed"] = options.seed;
  summary["samples"] = options.sweep.search.samples;
  summary["novelty"] = options.sweep.novelty_level;
  summary["threshold"] = options.sweep.search.refusal_threshold;
  extent.Put(&summary);
  summary["records"] = scenes;
  base::WriteJsonFile(options.json_file, summary, 1);
  return extent.exit_code();
}

}  // namespace
}  // namespace prospect::tools

int main(int argc, char** argv) {
  return prospect::tools::RunTorchMain([&] { return prospect::tools::Main(argc, argv); },
                                       "prospect-evaluate-shifts");
}
