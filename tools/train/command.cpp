#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/lock.h"
#include "base/strict_json.h"
#include "cli/installation.h"
#include "cli/report_file.h"
#include "model/dataset.h"
#include "model/engine.h"
#include "model/recorded_trials.h"
#include "model/training/config_choices.h"
#include "model/training/export.h"
#include "model/training/recipe_file.h"
#include "model/training/scores.h"
#include "model/training/trainer.h"
#include "model/training/verdict.h"
#include "model/weights.h"
#include "tasks/task_folder.h"
#include "tools/common/recorded_report.h"
#include "tools/common/same_table.h"
#include "tools/common/task_training.h"
#include "tools/train/commands.h"
#include "tools/train/sweep.h"

namespace prospect::tools {
namespace {

constexpr std::size_t kMostJudged = 300;

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
  run.task = cli::TaskOf(a.task).spec.name;
  run.data = a.data;
  run.folder = a.out;
  run.variant = a.variant;
  run.from = a.from;
  run.fresh.insert(a.fresh.begin(), a.fresh.end());
  run.device = a.device;
  run.threads = a.threads;
  run.minutes = a.minutes;
  run.stages.insert(a.stages.begin(), a.stages.end());
  return run;
}

model::TrainConfig ConfigOf(const cli::TrainOptions& a) {
  model::ConfigChoices choices;
  choices.task = TrainConfigOf(cli::TaskOf(a.task), a.data);
  if (!a.config.empty()) choices.changes = ReadChanges(a.config);
  choices.paper = a.paper;
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

// f of each action on held-out trials, evenly spread ones where there are many: in which of them
// the whole says nothing.
nlohmann::json ByAction(const cli::TrainOptions& a, const model::TrialFile& file,
                        const std::string& weights) {
  const std::vector<std::size_t> all = model::HeldOutTrials(file, false);
  std::vector<std::size_t> chosen;
  const std::size_t step = all.size() / kMostJudged + 1;
  for (std::size_t i = 0; i < all.size(); i += step) chosen.push_back(all[i]);
  const auto engine = model::LoadEngine(weights, a.threads);
  const model::RecordedTrials judged = model::JudgeRecorded(*engine, file, chosen, {});
  return ReportOf(judged, ActionNames(a.task), std::nullopt).at("f").at("actions");
}

// What was learned, where it is, and what to do with it.
void TellEnd(const cli::TrainOptions& a, const model::Trainer& trainer,
             const nlohmann::json& scores, const std::string& weights) {
  const char* task = a.task.c_str();
  std::printf("%s", model::Verdict(scores).c_str());
  if (scores.contains("f_actions"))
    std::printf("%s", model::ActionVerdict(scores["f_actions"]).c_str());
  std::printf("Weights: %s\nCurves: %s/curves.csv\n", weights.c_str(),
              trainer.weights_folder().c_str());
  std::printf("Every score: ./prospect train --task %s --data %s --out %s --score %s\n", task,
              a.data.c_str(), a.out.c_str(), weights.c_str());
  if (scores.contains("plan") && !cli::TaskOf(a.task).simulator) {
    std::printf("Next: ./prospect evaluate calibrate --task %s --weights %s --data %s\n", task,
                weights.c_str(), a.data.c_str());
    return;
  }
  const char* next = scores.contains("plan") ? "evaluate" : "figures";  // it takes heads to plan
  std::printf("Next: ./prospect %s --task %s --weights %s\n", next, task, weights.c_str());
}

// Scores the networks and writes them. @return the weights file, and the scores
std::pair<std::string, nlohmann::json> Export(const cli::TrainOptions& a,
                                              const model::Trainer& trainer) {
  model::RoundToHalf(trainer.context().networks);
  const nlohmann::json scores = ScoresOf(a, trainer);
  return {model::ExportWeights(trainer, scores), scores};
}

void Finish(const cli::TrainOptions& a, const model::Trainer& trainer) {
  auto [weights, scores] = Export(a, trainer);
  if (scores.contains("plan")) scores["f_actions"] = ByAction(a, trainer.file(), weights);
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

// The file as it is named, or in the installation: recipes/stacking.json is found from anywhere.
model::RecipeFile RecipeOf(const cli::TrainOptions& a) {
  const bool there = std::filesystem::exists(a.recipe);
  return model::ReadRecipe(there ? a.recipe : cli::DataFolder(a.recipe));
}

// A run's configuration, with what may be said beside a recipe.
model::TrainConfig ConfigOf(const cli::TrainOptions& a, const model::RecipeRun& run) {
  model::TrainConfig config = run.config;
  if (a.iterations > 0) model::ScaleIterations(a.iterations, &config);
  if (!a.precision.empty()) config.precision = a.precision;
  if (a.seed >= 0) config.seed = static_cast<std::uint64_t>(a.seed);
  model::Validate(config);
  return config;
}

// Whether a run has ended before, with this configuration and these data. Its weights then stay as
// they are: written again they would be others by their hash, and later runs would begin anew.
bool HasEnded(const std::string& weights, const model::TrainConfig& config,
              const std::string& data_hash) {
  if (!std::filesystem::exists(weights)) return false;
  const nlohmann::json made = model::ReadWeights(weights).metadata;
  return made.value("train", nlohmann::json()) == nlohmann::json(config) &&
         made.value("data_hash", "") == data_hash;
}

void TellNext(const model::RecipeFile& recipe, const std::string& weights) {
  for (std::string next : recipe.then) {
    const std::size_t at = next.find("{weights}");
    if (at != std::string::npos) next.replace(at, 9, weights);
    std::printf("Next: %s\n", next.c_str());
  }
}

// What a run of a recipe is trained with and where, as if it had been typed.
cli::TrainOptions OptionsOf(const cli::TrainOptions& a, const model::RecipeFile& recipe,
                            const model::RecipeRun& run, const std::string& from) {
  cli::TrainOptions one = a;
  one.task = recipe.task;
  one.out = a.out + "/" + run.name;
  one.fresh = run.fresh;
  one.from = from;
  return one;
}

void PrintConfigs(const cli::TrainOptions& a, const model::RecipeFile& recipe) {
  nlohmann::json configs = nlohmann::json::object();
  for (const model::RecipeRun& run : recipe.runs) configs[run.name] = ConfigOf(a, run);
  std::printf("%s\n", configs.dump(2).c_str());
}

// Trains what has not ended, each run from the weights of the one before.
void TrainRuns(const cli::TrainOptions& a, const model::RecipeFile& recipe,
               const std::string& command, const std::string& data_hash) {
  bool ended = true;
  std::string weights;
  for (const model::RecipeRun& run : recipe.runs) {
    const cli::TrainOptions one = OptionsOf(a, recipe, run, weights);
    const model::TrainConfig config = ConfigOf(a, run);
    weights = one.out + "/" + recipe.task + ".safetensors";
    const bool last = &run == &recipe.runs.back();
    ended = ended && HasEnded(weights, model::Resolved(config, a.device), data_hash);
    if (ended && !last) continue;
    if (a.report.talks()) std::fprintf(stderr, "run '%s'\n", run.name.c_str());
    model::TrainOptions options = RunOf(one);
    options.command = command;
    model::Trainer trainer(config, options);
    trainer.Run();
    if (last) {
      Finish(one, trainer);
    } else {
      Export(one, trainer);
    }
  }
  if (a.report.talks()) TellNext(recipe, weights);
}

int RunRecipe(const cli::TrainOptions& a, const std::string& command) {
  const model::RecipeFile recipe = RecipeOf(a);
  for (const model::RecipeRun& run : recipe.runs) ConfigOf(a, run);  // refused before hours
  if (a.print_config) {
    PrintConfigs(a, recipe);
    return 0;
  }
  const base::Lock own = base::LockFolder(a.out);
  const std::string data_hash = model::TrialFile(a.data).ContentHash();
  if (data_hash != recipe.data_hash && a.report.talks()) {
    std::fprintf(stderr, "%s: not the trials that the recipe is made for\n", a.data.c_str());
  }
  TrainRuns(a, recipe, command, data_hash);
  return 0;
}

}  // namespace

int RunTrain(const cli::TrainOptions& options, const std::string& command) {
  if (!options.sweep.empty()) return RunTrain(SweptRun(options), command);
  if (!options.recipe.empty()) return RunRecipe(options, command);
  const model::TrainConfig config = ConfigOf(options);
  if (options.print_config) {
    std::printf("%s\n", nlohmann::json(config).dump(2).c_str());
    return 0;
  }
  if (tasks::MeansFile(options.task))
    RequireSameTable(cli::TaskOf(options.task), model::TrialFile(options.data));
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
