#include <nlohmann/json.hpp>

#include "cli/report_file.h"
#include "model/calibration.h"
#include "planner/goal.h"
#include "tools/common/words.h"
#include "tools/common/world.h"
#include "tools/evaluate/calibrate.h"
#include "tools/evaluate/closed_loop.h"
#include "tools/evaluate/commands.h"
#include "tools/evaluate/report.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

ClosedLoop LoopOf(const cli::EvaluateOptions& options) {
  ClosedLoop loop;
  loop.task = options.task;
  loop.weights = cli::WeightsFile(options.weights, options.task);
  loop.world = WorldOf(options.scene);
  if (options.shift.strength > 0)
    sim::SetShift(options.shift.factor, options.shift.strength, &loop.world);
  loop.scenes = options.scenes;
  loop.wanted = {options.solvable, options.hopeless};
  loop.seed = options.seed;
  Ask(options.search, options.goal, &loop);
  loop.threshold = options.threshold;
  loop.novelty = options.novelty;
  loop.open_loop = options.open_loop;
  loop.rows = options.rows;
  if (loop.rows.empty() || loop.rows.front() != "planner")
    loop.rows.insert(loop.rows.begin(), "planner");
  loop.jobs = options.jobs;
  loop.videos = options.videos;
  loop.shard = options.shard;
  return loop;
}

// By what is stored with the weights.
double PromisedThreshold(const cli::PromiseOptions& promise, const ClosedLoop& loop) {
  const double threshold = PromisedThresholdOf(loop.weights, PromiseOf(promise), KindAsked(loop));
  Words() << "refusal threshold " << threshold << "\n";
  return threshold;
}

// `not_covered`: what the weights were not calibrated for; empty: nothing.
json Report(const cli::EvaluateOptions& options, const ClosedLoop& loop, const SceneRuns& runs,
            const std::string& not_covered) {
  json report = ReportOf(loop, runs);
  report["factor"] = options.shift.factor;
  report["strength"] = options.shift.strength;
  report["not_covered"] = not_covered;
  return report;
}

}  // namespace

int RunEvaluate(const cli::EvaluateOptions& options) {
  ClosedLoop loop = LoopOf(options);
  CheckInputs(loop);
  if (options.promise.asked()) loop.threshold = PromisedThreshold(options.promise, loop);
  const std::string not_covered = HeedCoverage(loop.weights, KindAsked(loop), &loop.threshold);
  const Items scenes = ScenesOf(loop, model::WeightsFileHash(loop.weights));
  const SceneRuns runs = RunClosedLoops(loop, scenes);
  Tell(loop, runs);
  if (options.shard.given())
    return WritePart(options.shard, options.report, "evaluate", scenes, runs);
  cli::WriteReport(options.report, Report(options, loop, runs, not_covered));
  return runs.extent.exit_code();
}

}  // namespace prospect::tools
