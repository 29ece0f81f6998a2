// prospect-evaluate-refusals: whether the promises about refusals hold, from scenes that were
// evaluated before: a threshold from a random half of them, tried on the other half, many times.
// Needs no simulation: the sample comes with the weights, or from a report of prospect-evaluate.

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "base/json_file.h"
#include "base/stop_signals.h"
#include "base/strict_json.h"
#include "model/calibration.h"
#include "model/dataset.h"
#include "model/weights.h"
#include "report/refusal_plot.h"
#include "tools/common/extent.h"
#include "tools/common/torch_main.h"
#include "tools/evaluate/calibrate.h"
#include "tools/refusals/report.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

struct Options {
  std::vector<std::string> weights, reports;
  std::string json_file, plot_file;
  RefusalOptions measure;                                 // of all
  std::vector<double> alphas = {0.05}, epsilons = {0.1};  // one for all, or one a file
};

void AddOptions(CLI::App* app, Options* o) {
  const auto share = CLI::Range(0.0001, 0.9999);
  CLI::Option* weights = app->add_option(
      "--weights", o->weights, "Weights files whose calibration samples are taken, one or more");
  app->add_option(
         "--report", o->reports,
         "Reports of prospect-evaluate --threshold 0 --json on calibration scenes, instead")
      ->excludes(weights);
  app->add_option("--splits", o->measure.splits, "Random halves")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app->add_option("--seed", o->measure.seed, "Of the first split; the others count on")
      ->capture_default_str();
  app->add_option("--alpha,--refuse-at-most", o->alphas,
                  "Share of solvable scenes that may be refused; one for all, or one a file")
      ->delimiter(',')
      ->check(share)
      ->capture_default_str();
  app->add_option("--epsilon,--fail-at-most", o->epsilons,
                  "Share of attempted scenes that may fail; one for all, or one a file")
      ->delimiter(',')
      ->check(share)
      ->capture_default_str();
  app->add_option("--delta", o->measure.delta,
                  "--epsilon holds with probability 1 - delta over calibration samples")
      ->check(share)
      ->capture_default_str();
  app->add_option("--json", o->json_file, "Also write the figures and curves here");
  app->add_option("--plot", o->plot_file, "Also draw risk against coverage into this PNG");
}

struct Named {
  std::string task;
  model::CalibrationSample sample;
};

Named FromWeights(const std::string& path) {
  const model::WeightsFile file = model::ReadWeights(path);
  Named named{file.metadata.value("task", path), model::CalibrationOf(file, path).sample};
  if (!named.sample.empty()) return named;
  throw model::WeightsError(path +
                            ": carries no calibration sample: ./prospect evaluate --calibrate "
                            "makes one");
}

Named FromReport(const std::string& path) try {
  std::ifstream in(path);
  const json report = base::ParseStrictJson(in);
  if (report.is_discarded())
    throw model::DataError(path + ": is no report of prospect-evaluate: it is not JSON");
  if (report.value("threshold", 0.0) != 0)
    throw model::DataError(path + ": plans were refused there; evaluate with --threshold 0");
  return {report.at("task"), SampleFrom(report.at("records").get<std::vector<SceneRecord>>())};
} catch (const base::KeyTwiceError& error) {
  throw model::DataError(path + ": " + error.what());
} catch (const json::exception& error) {
  throw model::DataError(path + ": is no report of prospect-evaluate (" + error.what() + ")");
}

// The target of file i of `files`.
double Of(const std::vector<double>& targets, std::size_t i, std::size_t files) {
  if (targets.size() != 1 && targets.size() != files)
    throw std::invalid_argument("give one --alpha and --epsilon, or one for each of " +
                                std::to_string(files) + " files");
  return targets[targets.size() == 1 ? 0 : i];
}

int Main(int argc, char** argv) {
  Options options;
  CLI::App app("Whether the promises about refusals hold over random calibration splits");
  AddOptions(&app, &options);
  try {
    app.parse(argc, argv);
    if (options.weights.empty() && options.reports.empty())
      throw CLI::RequiredError("--weights or --report");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  base::InstallStopSignals();
  std::vector<Named> samples;
  for (const std::string& path : options.weights) samples.push_back(FromWeights(path));
  for (const std::string& path : options.reports) samples.push_back(FromReport(path));
  std::vector<json> figures;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Named& named = samples[i];
    options.measure.alpha = Of(options.alphas, i, samples.size());
    options.measure.epsilon = Of(options.epsilons, i, samples.size());
    figures.push_back(MeasureRefusals(named.sample, named.task, options.measure));
    std::cout << RefusalTable(figures.back()) << model::CurveTable(named.sample);
  }
  if (!options.plot_file.empty()) report::WriteRefusalPlot(options.plot_file, figures);
  if (!options.json_file.empty()) base::WriteJsonFile(options.json_file, figures, 1);
  return base::StopRequested() ? kExitInterrupted : 0;
}

}  // namespace
}  // namespace prospect::tools

int main(int argc, char** argv) {
  return prospect::tools::RunTorchMain([&] { return prospect::tools::Main(argc, argv); },
                                       "prospect-evaluate-refusals");
}
