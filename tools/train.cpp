// prospect-train: trains the networks of a task from a data set (docs/training.md).

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/json_file.h"
#include "base/lock.h"
#include "base/strict_json.h"
#include "model/dataset.h"
#include "model/training/config_choices.h"
#include "model/training/export.h"
#include "model/training/recipe.h"
#include "model/training/scores.h"
#include "model/training/trainer.h"
#include "model/training/variants.h"
#include "model/training/verdict.h"
#include "model/weights.h"
#include "tools/common/torch_main.h"

namespace prospect {
namespace {

struct Arguments {
  model::TrainOptions options;
  std::string config_file;
  std::string json_file;
  std::string scored_weights;
  model::ConfigChoices choices;
  std::vector<std::string> stages;
  std::vector<std::string> fresh;
  std::string bundle;
  bool print_config = false;
};

std::string VariantHelp() {
  std::string help = "a row of the paper's comparison:";
  for (const model::Variant& v : model::Variants()) help += "\n" + v.name + ": " + v.what;
  return help;
}

std::string StepHelp() {
  std::string help = "leave these steps beyond the paper out, where the task takes them:";
  for (const model::RecipeStep& s : model::RecipeSteps()) help += "\n" + s.name + ": " + s.what;
  return help;
}

void AddOptions(CLI::App* app, Arguments* a) {
  app->add_option("--task", a->options.task, "the task to train for")->required();
  app->add_option("--data", a->options.data, "data set made by collect (HDF5)");
  app->add_option(
      "--out", a->options.folder,
      "folder for checkpoints and caches; weights and curves.csv go there, too, with --variant "
      "into a folder of that name inside");
  app->add_option("--iterations", a->choices.iterations,
                  "iterations of the transform network; the other stages scale with it")
      ->check(CLI::PositiveNumber);
  app->add_option("--variant", a->options.variant, VariantHelp());
  app->add_option("--recipe", a->choices.recipe,
                  "best: what a task turns on beyond the paper; paper: none of it, T updated as "
                  "often")
      ->check(CLI::IsMember({"paper", "best"}))
      ->capture_default_str();
  app->add_option("--without", a->choices.without, StepHelp())->delimiter(',');
  app->add_flag("--finetune", a->choices.finetune,
                "let encoder and decoder learn on with the transform network");
  app->add_option("--device", a->options.device, "cpu or cuda")
      ->check(CLI::IsMember({"cpu", "cuda"}));
  app->add_option("--from", a->options.from, "begin from these weights")->check(CLI::ExistingFile);
  app->add_option("--fresh", a->fresh,
                  "with --from: networks of these stages (as of --stage) begin from random weights "
                  "all the same")
      ->delimiter(',');
  app->add_option("--seed", a->choices.seed, "seed of first weights, batches and dropout")
      ->check(CLI::NonNegativeNumber);
  app->add_option("--config", a->config_file,
                  "JSON with the options to change (see --print-config)")
      ->check(CLI::ExistingFile);
  app->add_option("--precision", a->choices.precision,
                  "float32, or mixed: convolutions in 16-bit bfloat, about twice as fast on CUDA "
                  "and on processors with AVX512-BF16")
      ->check(CLI::IsMember({"float32", "mixed"}));
  app->add_option("--labels", a->choices.labels,
                  "what V, Q, p and f are taught: paper, or authors: as their code does it")
      ->check(CLI::IsMember({"paper", "authors"}));
  app->add_option("--threads", a->options.threads, "CPU threads")->check(CLI::Range(1, 256));
  app->add_option(
      "--stage", a->stages,
      "only these stages: classifier, second-classifier, encoder-decoder, transform, heads");
  app->add_option("--score", a->scored_weights,
                  "train nothing: score this weights file, and the classifiers' file beside it, on "
                  "the data's held-out trials")
      ->check(CLI::ExistingFile);
  app->add_option("--json", a->json_file, "write the scores here, too");
  app->add_option("--bundle", a->bundle,
                  "copy the weights into this folder, too, without C, which only training needs");
  app->add_flag("--print-config", a->print_config, "print the configuration and stop");
}

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

nlohmann::json ScoresOf(const Arguments& a, const model::Trainer& trainer) {
  return model::ComputeScores(trainer.context(), trainer.file(), a.options.threads);
}

void WriteScores(const Arguments& a, const nlohmann::json& scores) {
  if (a.json_file.empty()) return;
  base::WriteJsonFile(a.json_file, scores);
}

// What was learned, where it is, and what to do with it.
void TellEnd(const Arguments& a, const model::Trainer& trainer, const nlohmann::json& scores,
             const std::string& weights) {
  const char* task = a.options.task.c_str();
  std::printf("%sWeights: %s\nCurves: %s/curves.csv\n", model::Verdict(scores).c_str(),
              weights.c_str(), trainer.weights_folder().c_str());
  std::printf("Every score: ./prospect train --task %s --data %s --out %s --score %s\n", task,
              a.options.data.c_str(), a.options.folder.c_str(), weights.c_str());
  const char* next = scores.contains("plan") ? "evaluate" : "figures";  // it takes heads to plan
  std::printf("Next: ./prospect %s --task %s --weights %s\n", next, task, weights.c_str());
}

void Finish(const Arguments& a, const model::Trainer& trainer) {
  model::RoundToHalf(trainer.context().networks);
  const nlohmann::json scores = ScoresOf(a, trainer);
  const std::string weights = model::ExportWeights(trainer, scores);
  WriteScores(a, scores);
  if (!a.bundle.empty()) model::BundleWeights(weights, a.bundle);
  TellEnd(a, trainer, scores, weights);
}

// With the configuration that the weights were trained with, not this version's.
int ScoreOnly(const Arguments& a) {
  const nlohmann::json metadata = model::ReadWeights(a.scored_weights).metadata;
  if (!metadata.contains("train")) {
    throw model::WeightsError(a.scored_weights + ": does not say how it was trained");
  }
  model::TrainOptions options = a.options;
  options.score_only = true;
  model::Trainer trainer(metadata["train"].get<model::TrainConfig>(), options);
  trainer.Load(a.scored_weights);
  const nlohmann::json scores = ScoresOf(a, trainer);
  model::PrintScores(scores);
  std::printf("%s", model::Verdict(scores).c_str());
  WriteScores(a, scores);
  return 0;
}

int Run(Arguments a) {
  a.choices.task = a.options.task;
  a.choices.variant = a.options.variant;
  if (!a.config_file.empty()) a.choices.changes = ReadChanges(a.config_file);
  const model::TrainConfig config = model::ConfigOf(a.choices);
  if (a.print_config) {
    std::printf("%s\n", nlohmann::json(config).dump(2).c_str());
    return 0;
  }
  if (a.options.data.empty() || a.options.folder.empty()) {
    throw std::invalid_argument("--data and --out are required");
  }
  const base::Lock own = base::LockFolder(a.options.folder);
  if (!a.scored_weights.empty()) return ScoreOnly(a);
  a.options.stages.insert(a.stages.begin(), a.stages.end());
  a.options.fresh.insert(a.fresh.begin(), a.fresh.end());
  model::Trainer trainer(config, a.options);
  trainer.Run();
  if (!a.options.stages.empty()) return 0;  // part of the networks: nothing to score yet
  Finish(a, trainer);
  return 0;
}

}  // namespace
}  // namespace prospect

namespace {

// As it was typed, but of paths only the last part: the rest says nothing elsewhere.
std::string CommandOf(int argc, char** argv) {
  std::string command = "./prospect train";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    command += " " + word.substr(word.find_last_of('/') + 1);
  }
  return command;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Trains the networks of a task from a data set.");
  prospect::Arguments arguments;
  prospect::AddOptions(&app, &arguments);
  arguments.options.command = CommandOf(argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : prospect::kExitUsage;
  }
  return prospect::tools::RunTorchMain([&] { return prospect::Run(arguments); }, "prospect-train");
}
