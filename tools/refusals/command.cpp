#include <cstddef>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/exit_codes.h"
#include "base/stop_signals.h"
#include "base/strict_json.h"
#include "cli/options/task.h"
#include "cli/report_file.h"
#include "model/calibration.h"
#include "model/dataset.h"
#include "model/refusal/scene_kind.h"
#include "model/weights_file.h"
#include "report/refusal_plot.h"
#include "tools/common/extent.h"
#include "tools/common/words.h"
#include "tools/evaluate/calibrate.h"
#include "tools/evaluate/commands.h"
#include "tools/refusals/report.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

struct Named {
  std::string task;
  model::CalibrationSample sample;
  std::size_t file = 0;  // of those that are named, by order
};

// One for each kind of scenes that they were calibrated on.
std::vector<Named> FromWeights(const std::string& path) {
  const model::WeightsFile file = model::ReadWeights(path);
  const std::string task = file.metadata.value("task", path);
  std::vector<Named> all;
  for (const auto& sample : model::SamplesOf(model::CalibrationsOf(file, path))) {
    const model::SceneKind kind = model::KindOf(sample);
    const std::string name = task + ", " + std::to_string(kind.plan_length) + " actions, " +
                             std::to_string(kind.objects) + " objects";
    all.push_back({all.empty() ? task : name, sample});
  }
  if (!all.empty()) return all;
  throw model::WeightsError(path +
                            ": carries no calibration sample: ./prospect evaluate calibrate "
                            "makes one");
}

// Of the next file.
void Add(std::vector<Named> more, std::vector<Named>* samples) {
  const std::size_t file = samples->empty() ? 0 : samples->back().file + 1;
  for (Named& named : more) {
    named.file = file;
    samples->push_back(std::move(named));
  }
}

Named FromReport(const std::string& path) try {
  std::ifstream in(path);
  const json report = base::ParseStrictJson(in);
  if (report.is_discarded())
    throw model::DataError(path + ": is no report of ./prospect evaluate: it is not JSON");
  if (report.value("threshold", 0.0) != 0)
    throw model::DataError(path + ": plans were refused there; evaluate with --threshold 0");
  return {report.at("task"), SampleFrom(report.at("records").get<std::vector<SceneRecord>>())};
} catch (const base::KeyTwiceError& error) {
  throw model::DataError(path + ": " + error.what());
} catch (const json::exception& error) {
  throw model::DataError(path + ": is no report of ./prospect evaluate (" + error.what() + ")");
}

// The target of file i of `files`.
double Of(const std::vector<double>& targets, std::size_t i, std::size_t files) {
  if (targets.size() != 1 && targets.size() != files)
    throw std::invalid_argument(
        "give one --refuse-at-most and --fail-at-most, or one for each of " +
        std::to_string(files) + " files");
  return targets[targets.size() == 1 ? 0 : i];
}

// Of the files that are named, or of the bundled weights.
std::vector<Named> SamplesOf(const cli::RefusalsOptions& options) {
  std::vector<Named> samples;
  for (const std::string& path : options.reports) Add({FromReport(path)}, &samples);
  for (const std::string& path : options.weights) Add(FromWeights(path), &samples);
  if (!samples.empty()) return samples;
  std::vector<std::string> tasks = options.tasks;
  if (tasks.empty()) tasks = cli::TaskNames(cli::Tasks::kPlanned);
  for (const std::string& task : tasks) Add(FromWeights(cli::WeightsFile("", task)), &samples);
  return samples;
}

}  // namespace

int RunRefusals(const cli::RefusalsOptions& options) {
  base::InstallStopSignals();
  const std::vector<Named> samples = SamplesOf(options);
  RefusalOptions measure;
  measure.splits = options.splits;
  measure.seed = options.seed;
  measure.delta = options.delta;
  std::vector<json> figures;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Named& named = samples[i];
    measure.alpha = Of(options.alphas, named.file, samples.back().file + 1);
    measure.epsilon = Of(options.epsilons, named.file, samples.back().file + 1);
    figures.push_back(MeasureRefusals(named.sample, named.task, measure));
    Words() << RefusalTable(figures.back()) << model::CurveTable(named.sample);
  }
  if (!options.plot.empty()) report::WriteRefusalPlot(options.plot, figures);
  cli::WriteReport(options.report, figures);
  return base::StopRequested() ? kExitInterrupted : kExitSuccess;
}

}  // namespace prospect::tools
