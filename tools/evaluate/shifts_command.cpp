#include <memory>

#include "base/lock.h"
#include "cli/report_file.h"
#include "model/weights_file.h"
#include "report/shift_plot.h"
#include "tools/common/fork_map.h"
#include "tools/common/progress.h"
#include "tools/common/words.h"
#include "tools/common/world.h"
#include "tools/evaluate/calibrate.h"
#include "tools/evaluate/commands.h"
#include "tools/evaluate/record_file.h"
#include "tools/evaluate/rule.h"
#include "tools/evaluate/scene_runs.h"
#include "tools/evaluate/shift_sweep.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

// What is swept, and how far.
struct Sweep {
  cli::EvaluateShiftsOptions options;
  SweepOptions sweep;  // the library's
};

// What the records of scenes depend on.
json KeyOf(const Sweep& o) {
  const SweepOptions& sweep = o.sweep;
  return {{"task", sweep.task},
          {"weights", std::to_string(model::WeightsFileHash(sweep.weights))},
          {"factors", o.options.factors},
          {"objects", sweep.world.objects},
          {"legs", sweep.world.legs},
          {"tower", sweep.world.tower},
          {"scene_file", sweep.world.scene_file},
          {"samples", sweep.search.samples},
          {"v_failed", sweep.search.v_failed},
          {"novelty", sweep.novelty_level},
          {"threshold", sweep.search.refusal_threshold}};
}

// Refuses what is out of range.
model::SceneKind KindAsked(const cli::EvaluateShiftsOptions& options, const SweepOptions& sweep) {
  const auto task = sim::MakeTask(sweep.task, sweep.world);
  task->Reset(options.seed);
  return KindOf(*task);
}

double ThresholdOf(const cli::EvaluateShiftsOptions& options, const SweepOptions& sweep) {
  RequireWeightsOf(sweep.task, sweep.weights);
  double threshold = options.threshold;
  HeedCoverage(sweep.weights, KindAsked(options, sweep), &threshold);
  if (threshold >= 0) return threshold;
  return model::LoadEngine(sweep.weights, 1)->info().refusal_threshold;
}

Sweep SweepOf(const cli::EvaluateShiftsOptions& options) {
  Sweep sweep{options, {}};
  sweep.sweep.task = options.task;
  sweep.sweep.weights = cli::WeightsFile(options.weights, options.task);
  sweep.sweep.world = WorldOf(options.scene);
  sweep.sweep.search.samples = options.samples;
  sweep.sweep.search.UseRule(RuleOf(sweep.sweep.weights, KindAsked(options, sweep.sweep)));
  sweep.sweep.novelty_level = options.novelty;
  sweep.sweep.points = ShiftPoints(options.factors);
  sweep.sweep.search.refusal_threshold = ThresholdOf(options, sweep.sweep);
  if (options.out.empty()) sweep.options.out = "out/shifts-" + options.task;
  WarnWithoutNovelty(sweep.sweep.weights);
  return sweep;
}

// Of the scenes that have none yet; each is on disk as soon as it is made.
void MakeMissing(const Sweep& sweep, RecordFile* file) {
  const cli::EvaluateShiftsOptions& options = sweep.options;
  std::vector<std::uint64_t> missing;
  for (int i = 0; i < options.scenes; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    if (!file->records().contains(seed)) missing.push_back(seed);
  }
  if (missing.empty()) return;
  const int scenes = static_cast<int>(missing.size());
  Progress progress("scenes", scenes);
  // What is missing after a stop is seen by what the file holds.
  [[maybe_unused]] const Extent made = ForkMap(
      scenes, options.jobs,
      [&]() {
        auto points = std::make_shared<ShiftSweep>(sweep.sweep);
        return [points, &missing](int i) {
          return points->Run(missing[static_cast<std::size_t>(i)]).dump();
        };
      },
      [&](int, const std::string& line) {
        file->Store(json::parse(line));
        progress.Step();
      });
}

json Report(const Sweep& sweep, const std::vector<json>& scenes, const Extent& extent,
            json summary) {
  summary["task"] = sweep.sweep.task;
  summary["first_seed"] = sweep.options.seed;
  summary["samples"] = sweep.sweep.search.samples;
  summary["novelty"] = sweep.sweep.novelty_level;
  summary["threshold"] = sweep.sweep.search.refusal_threshold;
  extent.Put(&summary);
  summary["records"] = scenes;
  return summary;
}

// In seed order.
std::vector<json> ScenesIn(const RecordFile& file, const cli::EvaluateShiftsOptions& options) {
  std::vector<json> scenes;
  for (int i = 0; i < options.scenes; ++i) {
    const auto found = file.records().find(options.seed + static_cast<std::uint64_t>(i));
    if (found != file.records().end()) scenes.push_back(found->second);
  }
  return scenes;
}

}  // namespace

int RunShifts(const cli::EvaluateShiftsOptions& options) {
  const Sweep sweep = SweepOf(options);
  const base::Lock own = base::LockFolder(sweep.options.out);
  RecordFile file(sweep.options.out + "/records.jsonl", KeyOf(sweep));
  MakeMissing(sweep, &file);
  const std::vector<json> scenes = ScenesIn(file, options);
  const Extent extent{static_cast<int>(scenes.size()), options.scenes};
  const json summary = SummariseShifts(scenes, sweep.sweep.points);
  Words() << ShiftTable(summary) << extent.Line("scenes");
  const std::string plot = sweep.options.out + "/shifts.png";
  report::WriteShiftPlot(plot, summary, "Pictures unlike the known ones: " + options.task);
  Words() << "plot: " << plot << "\n";
  cli::WriteReport(options.report, Report(sweep, scenes, extent, summary));
  return extent.exit_code();
}

}  // namespace prospect::tools
