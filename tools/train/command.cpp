#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "base/lock.h"
#include "base/strict_json.h"
#include "cli/report_file.h"
#include "model/dataset.h"
#include "model/training/config_choices.h"
#include "model/training/export.h"
#include "model/training/scores.h"
#include "model/training/trainer.h"
#include "model/training/verdict.h"
#include "model/weights.h"
#include "tools/train/commands.h"

namespace prospect::tools {
namespace {

// Of --config FILE.
nlohmann::json ReadChanges(const std::string& path) {
  std::ifstream in(path);
  try {
    nlohmann::json changes = base::ParseStrictJson(in);
    if (changes.is_discarded()) throw std::invalid_argument(path + ": is not JSON");
    return changes;
  } catch (const base::KeyTwiceError& error) {
    throw std::invalid_argument(path + ": " + error.what());
  }
}

// The options as the library takes them.
model::TrainOptions RunOf(const cli::TrainOptions& a) {
  model::TrainOptions run;
  run.task = a.task;
  run.data = a.data;
  run.folder = a.out;
  run.variant = a.variant;
  run.from = a.from;
  run.fresh.insert(a.fresh.begin(), a.fresh.end());
  run.device = a.device;
  run.threads = a.threads;
  run.stages.insert(a.stages.begin(), a.stages.end());
  return run;
}

model::TrainConfig ConfigOf(const cli::TrainOptions& a) {
  model::ConfigChoices choices;
  choices.task = a.task;
  if (!a.config.empty()) choices.changes = ReadChanges(a.config);
  choices.recipe = a.recipe;
  choices.without = a.without;
  choices.iterations = a.iterations;
  choices.variant = a.variant;
  choices.finetune = a.finetune;
  choices.precision = a.precision;
  choices.labels = a.labels;
  choices.seed = a.seed;
  return model::ConfigOf(choices);
}

nlohmann::json ScoresOf(const cli::TrainOptions& a, const model::Trainer& trainer) {
  return model::ComputeScores(trainer.context(), trainer.file(), a.threads);
}

// What was learned, where it is, and what to do with it.
void TellEnd(const cli::TrainOptions& a, const model::Trainer& trainer,
             const nlohmann::json& scores, const std::string& weights) {
  const char* task = a.task.c_str();
  std::printf("%sWeights: %s\nCurves: %s/curves.csv\n", model::Verdict(scores).c_str(),
              weights.c_str(), trainer.weights_folder().c_str());
  std::printf("Every score: ./prospect train --task %s --data %s --out %s --score %s\n", task,
              a.data.c_str(), a.out.c_str(), weights.c_str());
  const char* next = scores.contains("plan") ? "evaluate" : "figures";  // it takes heads to plan
  std::printf("Next: ./prospect %s --task %s --weights %s\n", next, task, weights.c_str());
}

void Finish(const cli::TrainOptions& a, const model::Trainer& trainer) {
  model::RoundToHalf(trainer.context().networks);
  const nlohmann::json scores = ScoresOf(a, trainer);
  const std::string weights = model::ExportWeights(trainer, scores);
  if (!a.bundle.empty()) model::BundleWeights(weights, a.bundle);
  if (a.report.talks()) TellEnd(a, trainer, scores, weights);
  cli::WriteReport(a.report, scores);
}

// With the configuration that the weights were trained with, not this version's.
int ScoreOnly(const cli::TrainOptions& a) {
  const nlohmann::json metadata = model::ReadWeights(a.score).metadata;
  if (!metadata.contains("train")) {
    throw model::WeightsError(a.score + ": does not say how it was trained");
  }
  model::TrainOptions options = RunOf(a);
  options.score_only = true;
  model::Trainer trainer(metadata["train"].get<model::TrainConfig>(), options);
  trainer.Load(a.score);
  const nlohmann::json scores = ScoresOf(a, trainer);
  if (a.report.talks()) {
    model::PrintScores(scores);
    std::printf("%s", model::Verdict(scores).c_str());
  }
  cli::WriteReport(a.report, scores);
  return 0;
}

}  // namespace

int RunTrain(const cli::TrainOptions& options, const std::string& command) {
  const model::TrainConfig config = ConfigOf(options);
  if (options.print_config) {
    std::printf("%s\n", nlohmann::json(config).dump(2).c_str());
    return 0;
  }
  const base::Lock own = base::LockFolder(options.out);
  if (!options.score.empty()) return ScoreOnly(options);
  model::TrainOptions run = RunOf(options);
  run.command = command;
  model::Trainer trainer(config, run);
  trainer.Run();
  if (!options.stages.empty()) return 0;  // part of the networks: nothing to score yet
  Finish(options, trainer);
  return 0;
}

}  // namespace prospect::tools
