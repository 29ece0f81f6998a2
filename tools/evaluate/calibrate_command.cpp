#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "cli/options/task.h"
#include "cli/report_file.h"
#include "model/calibration.h"
#include "model/refusal/promise.h"
#include "model/turns.h"
#include "planner/goal.h"
#include "tools/common/recorded_report.h"
#include "tools/common/words.h"
#include "tools/common/world.h"
#include "tools/evaluate/calibrate.h"
#include "tools/evaluate/closed_loop.h"
#include "tools/evaluate/commands.h"
#include "tools/evaluate/recorded.h"

namespace prospect::tools {
namespace {

// Weights of few trials are sure of too much: their V and f may rule every future out, so plans are
// looked for where they fail least, and only certain failures are given up.
constexpr char kRuleOfData[] = "best_first";

// Calibration looks at the planner's scores alone, on scenes kept for it, with nothing refused.
ClosedLoop LoopOf(const cli::CalibrateOptions& options) {
  ClosedLoop loop;
  loop.task = options.task;
  loop.weights = cli::WeightsFile(options.weights, options.task);
  loop.world = WorldOf(options.scene);
  loop.scenes = options.scenes;
  loop.seed = options.seed;
  Ask(options.search, options.goal, &loop);
  loop.threshold = 0;
  loop.rows = {"planner"};
  loop.jobs = options.jobs;
  loop.shard = options.shard;
  return loop;
}

// What is stored with the weights has no part in the scores, but for their turns and rule.
Items ScenesToCalibrateOn(const ClosedLoop& loop) {
  Items scenes = ScenesOf(loop, model::TensorsHash(model::ReadWeights(loop.weights)));
  scenes.made_of["turns"] = model::TurnsOf(loop.weights);
  scenes.made_of["rule"] = loop.search.rule;
  return scenes;
}

model::Promise PromiseAsked(const cli::CalibrateOptions& options) {
  model::Promise promise = PromiseOf(options.promise);
  if (!promise.asked()) promise.refuse_at_most = 0.05;
  return promise;
}

// What differs from the defaults.
std::string SceneWords(const cli::SceneOptions& scene) {
  std::string text;
  const auto add = [&text](const char* name, int value) {
    if (value > 0) text += std::string(" --") + name + " " + std::to_string(value);
  };
  add("objects", scene.objects);
  add("legs", scene.legs);
  add("tower", scene.tower);
  if (!scene.scene_file.empty()) text += " --scene-file " + scene.scene_file;
  return text;
}

void AddPromise(const model::Promise& promise, std::ostream* text) {
  if (promise.refuse_at_most) *text << " --refuse-at-most " << *promise.refuse_at_most;
  if (promise.fail_at_most)
    *text << " --fail-at-most " << *promise.fail_at_most << " --delta " << promise.delta;
}

// It is kept in the weights.
std::string CommandOf(const cli::CalibrateOptions& options, const ClosedLoop& loop,
                      const model::Promise& promise) {
  std::ostringstream text;
  text << "./prospect evaluate calibrate --task " << options.task << SceneWords(options.scene)
       << " --scenes " << options.scenes << " --seed " << options.seed << " --samples "
       << loop.search.samples << " --rule " << loop.search.rule << " --v-failed "
       << loop.search.v_failed;
  if (options.turns > 0) text << " --turns " << options.turns;
  AddPromise(promise, &text);
  return text.str();
}

// It is kept in the weights: of paths only the last part.
std::string DataCommandOf(const cli::CalibrateOptions& options, const model::Promise& promise) {
  std::ostringstream text;
  text << "./prospect evaluate calibrate --task "
       << std::filesystem::path(options.task).filename().string() << " --data "
       << std::filesystem::path(options.data).filename().string();
  if (options.all) text << " --all-trials";
  if (!options.search.rule.empty()) text << " --rule " << options.search.rule;
  if (options.turns > 0) text << " --turns " << options.turns;
  AddPromise(promise, &text);
  return text.str();
}

// What a recorded plan's score depends on; how it was found does not matter.
std::map<std::string, double> RecordedParameters(const model::RecordedTrials& judged,
                                                 const model::GivenUpBelow& limits) {
  return {{"c_done", limits.done},
          {"v_failed", limits.value},
          {"p_min", limits.possible},
          {"plan_length", judged.trials.front().plan_length}};
}

// What is stored with the weights is for the task's own goal; of another one the threshold is told.
void Calibrate(const cli::CalibrateOptions& options, const ClosedLoop& loop,
               const std::vector<SceneRecord>& scenes) {
  model::CalibrationSample sample = SampleFrom(scenes);
  sample.rule = loop.search.rule;
  sample.parameters = CoveredParameters(loop.search, KindAsked(loop), loop.retries);
  const model::Promise promise = PromiseAsked(options);
  std::vector<std::string> sentences;
  const model::Calibration calibration =
      CalibrationFrom(sample, promise, CommandOf(options, loop, promise), &sentences);
  for (const std::string& sentence : sentences) Words() << sentence << "\n";
  Words() << model::CurveTable(sample) << "refusal threshold " << calibration.refusal_threshold
          << " from " << calibration.scenes;
  if (!loop.goal.empty()) {
    Words() << " scenes where " << planner::ToString(loop.goal)
            << " is solvable; not stored, since the weights' own is for the task's goal: give it "
               "as --refusal-threshold (evaluate: --threshold)\n";
    return;
  }
  model::StoreCalibration(loop.weights, calibration);
  Words() << " solvable scenes, stored in " << loop.weights << " with all " << sample.scenes.size()
          << " scenes\n";
}

// Where nothing is asked: the least share of plans that succeed to be refused that so few trials
// can promise. Of random plans few succeed, and of these some are given up at any threshold.
model::Promise PromiseFor(const cli::CalibrateOptions& options,
                          const model::CalibrationSample& sample) {
  model::Promise promise = PromiseAsked(options);
  if (options.promise.asked()) return promise;
  for (int percent = 5; percent <= 30; ++percent) {
    promise.refuse_at_most = percent / 100.0;
    if (model::ThresholdFor(sample, promise).kept) break;
  }
  return promise;
}

// Of recorded trials: each holds one plan that was carried out, whatever its score.
int CalibrateByData(const cli::CalibrateOptions& options) {
  const std::string weights = cli::WeightsFile(options.weights, options.task);
  const std::string rule = options.search.rule.empty() ? kRuleOfData : options.search.rule;
  if (options.turns > 0) model::StoreTurns(weights, options.turns);
  const Recorded recorded = JudgeData(options.data, weights, rule, options.all);
  model::CalibrationSample sample = SampleOf(recorded.judged);
  sample.rule = rule;
  sample.parameters = RecordedParameters(recorded.judged, GivenUpBy(rule));
  const model::Promise promise = PromiseFor(options, sample);
  const std::string command = DataCommandOf(options, promise);
  std::vector<std::string> sentences;
  const model::Calibration calibration = CalibrationFrom(sample, promise, command, &sentences);
  model::StoreCalibration(weights, calibration);
  sentences.push_back(StoreRecordedNovelty(recorded, command));
  for (const std::string& sentence : sentences) Words() << sentence << "\n";
  Words() << model::CurveTable(sample) << "refusal threshold " << calibration.refusal_threshold
          << ", stored in " << weights << " with all " << sample.scenes.size()
          << " recorded plans, of which " << calibration.scenes << " succeeded\n";
  const std::vector<std::string> names = ActionNames(options.task);
  nlohmann::json report = ReportOf(recorded.judged, names, model::NoveltyGauge::Load(weights));
  report["task"] = cli::TaskOf(options.task).spec.name;
  report["threshold"] = calibration.refusal_threshold;
  cli::WriteReport(options.report, report);
  return kExitSuccess;
}

}  // namespace

int RunCalibrate(const cli::CalibrateOptions& options) {
  if (!options.data.empty()) return CalibrateByData(options);
  const ClosedLoop loop = LoopOf(options);
  CheckInputs(loop);
  if (options.turns > 0) model::StoreTurns(loop.weights, options.turns);
  const Items scenes = ScenesToCalibrateOn(loop);
  const SceneRuns runs = RunClosedLoops(loop, scenes);
  Tell(loop, runs);
  if (options.shard.given())
    return WritePart(options.shard, options.report, "evaluate calibrate", scenes, runs);
  if (runs.extent.stopped()) {
    Words() << "no calibration of so few scenes is stored\n";
  } else {
    Calibrate(options, loop, runs.records);
  }
  cli::WriteReport(options.report, ReportOf(loop, runs));
  return runs.extent.exit_code();
}

}  // namespace prospect::tools
