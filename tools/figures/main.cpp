// prospect-figures: the paper's figures from our own models, on held-out trials. Needs no bus.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <thread>

#include "base/hash.h"
#include "base/lock.h"
#include "model/engine.h"
#include "model/jigsaws/gestures.h"
#include "model/weights_error.h"
#include "tools/common/progress.h"
#include "tools/common/torch_main.h"
#include "tools/figures/calibration.h"
#include "tools/figures/futures.h"
#include "tools/figures/hidden_states.h"
#include "tools/figures/loaded_model.h"
#include "tools/figures/predictions.h"
#include "tools/figures/random_states.h"
#include "tools/figures/search.h"
#include "tools/figures/variants.h"

namespace prospect::figures {

using report::Page;

namespace {

namespace fs = std::filesystem;

constexpr int kMostScenes = 40;  // looked at for one that shows something
constexpr int kChains = 4;       // examples in variants.png
constexpr int kPictures = 6;     // in reconstructions.png

const std::vector<std::string> kNames = {"predictions",   "reconstructions", "hidden-states",
                                         "random-states", "variants",        "futures",
                                         "search",        "calibration"};
// Those that ask V, Q, p or f.
const std::set<std::string> kJudging = {"futures", "search", "calibration"};

struct Options {
  std::string task = "navigation";
  std::string weights, data, out, variants;
  std::uint64_t seed = 0;
  int trials = 200;
  int samples = 30;
  int examples = 6;
  std::vector<std::string> only;  // empty: all that the weights can draw
};

void AddOptions(CLI::App* app, Options* o) {
  app->add_option("--task", o->task, "Task")->capture_default_str();
  app->add_option("--weights", o->weights, "Weights file, or its folder")->required();
  app->add_option("--data", o->data, "Data set; only its test trials are read")->required();
  app->add_option("--out", o->out, "Folder for the pictures and captions.md")->required();
  app->add_option("--variants", o->variants,
                  "Folder of trained variants: NAME/TASK.safetensors each");
  app->add_option("--seed", o->seed, "Which trials and scenes are shown")->capture_default_str();
  app->add_option("--trials", o->trials, "Test trials for the calibration curves")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app->add_option("--samples", o->samples, "Rollouts of the search that is shown")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app->add_option("--examples", o->examples, "Rows of predictions.png")
      ->check(CLI::Range(1, 40))
      ->capture_default_str();
  app->add_option("--only", o->only, "Only these figures, by name")
      ->delimiter(',')
      ->check(CLI::IsMember(kNames));
}

// What all figures are made from.
struct Studio {
  std::string weights;
  LoadedModel own;
  std::unique_ptr<HeldOut> held_out;
  TaskTable table;
  int threads = 1;
};

std::string WeightsPath(const Options& options) {
  if (!fs::is_directory(options.weights)) return options.weights;
  return (fs::path(options.weights) / (options.task + ".safetensors")).string();
}

// Weights of another task answer with numbers, too.
void RequireTask(const model::Engine& engine, const std::string& path, const std::string& task,
                 const TaskTable& table) {
  const model::EngineInfo& info = engine.info();
  if (info.task != task || info.num_actions != table.rules.num_actions) {
    throw model::WeightsError(path + ": was trained for task '" + info.task + "', not for '" +
                              task + "': give weights of that task");
  }
}

void RequireData(const model::Trial& trial, const std::string& path, const std::string& task,
                 const TaskTable& table, const model::EngineInfo& info) {
  if (trial.task != task) {
    throw model::DataError(path + ": holds trials of task '" + trial.task + "', not of '" + task +
                           "'");
  }
  // Videos and the simulated scene share the gestures, and nothing else of a table.
  const bool other = !model::jigsaws::IsGestureTask(task) && trial.task_hash != table.hash;
  if (other || trial.num_actions != table.rules.num_actions) {
    throw model::DataError(path +
                           ": was made with another action table than this task's; collect "
                           "it anew");
  }
  if (trial.width != info.image_width || trial.height != info.image_height) {
    throw model::DataError(path + ": pictures are " + std::to_string(trial.width) + "x" +
                           std::to_string(trial.height) + ", the weights want " +
                           std::to_string(info.image_width) + "x" +
                           std::to_string(info.image_height));
  }
}

Studio OpenStudio(const Options& options) {
  Studio studio;
  studio.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 16U));
  studio.table = TableOf(options.task);
  studio.weights = WeightsPath(options);
  studio.own = LoadWeights(studio.weights, studio.threads);
  RequireTask(*studio.own.engine, studio.weights, options.task, studio.table);
  studio.held_out = std::make_unique<HeldOut>(options.data);
  const model::Trial trial = studio.held_out->Labels(0);
  RequireData(trial, options.data, options.task, studio.table, studio.own.engine->info());
  return studio;
}

planner::SearchParameters SearchOf(const Options& options, const Studio& studio) {
  planner::SearchParameters parameters;
  parameters.samples = options.samples;
  parameters.seed = options.seed;
  parameters.refusal_threshold = studio.own.engine->info().refusal_threshold;
  return parameters;
}

// The first trial in random order that went well, or the first that has any action.
SeenTrial ChooseTrial(const HeldOut& held_out, std::uint64_t seed) {
  const std::vector<std::size_t> order = held_out.Shuffled(seed);
  const auto chosen = std::find_if(order.begin(), order.end(), [&](std::size_t k) {
    const model::Trial trial = held_out.Labels(k);
    return trial.succeeded() && trial.segments() > 0;
  });
  if (chosen != order.end()) return held_out.Read(*chosen);
  const auto any = std::find_if(order.begin(), order.end(),
                                [&](std::size_t k) { return held_out.Labels(k).segments() > 0; });
  if (any == order.end()) throw model::DataError("no test trial of the data set has an action");
  return held_out.Read(*any);
}

Page MakeVariants(const Options& options, const Studio& studio) {
  VariantSet variants;
  if (!options.variants.empty()) {
    variants = LoadVariants(options.variants, options.task, studio.threads);
    for (const VariantSet::Member& member : variants.trained) {
      RequireTask(*member.loaded.engine, options.variants + ": " + member.name, options.task,
                  studio.table);
    }
  }
  const auto chains = ChooseChains(*studio.held_out, studio.table, kChains, options.seed);
  return DrawVariants(chains, studio.table, variants, studio.own, "these weights");
}

Page MakeCalibration(const Options& options, const Studio& studio) {
  const auto chosen = studio.held_out->Spread(static_cast<std::size_t>(options.trials));
  tools::Progress progress("trials judged", static_cast<int>(chosen.size()));
  HeadRecord record;
  for (const std::size_t k : chosen) {
    const SeenTrial trial = studio.held_out->Read(k);
    if (!trial.segments().empty()) {
      AddJudgements(trial, studio.own.engine.get(), studio.own.done, &record);
    }
    progress.Step();
  }
  return DrawCalibration(record, static_cast<int>(chosen.size()), options.task);
}

Page MakeRandomStates(const Options& options, const Studio& studio) {
  const SeenTrial trial = ChooseTrial(*studio.held_out, options.seed);
  const auto first = static_cast<std::size_t>(trial.trial().first);
  return DrawRandomStates(studio.table, studio.own, trial.seen[first], options.seed);
}

Page MakeFutures(const Options& options, const Studio& studio) {
  const planner::SearchParameters parameters = SearchOf(options, studio);
  const SceneFutures scene = FindFutures(*studio.held_out, studio.table, studio.own.engine.get(),
                                         parameters, kMostScenes, options.seed);
  return DrawFutures(scene, studio.table, studio.own, parameters);
}

Page MakeSearch(const Options& options, const Studio& studio) {
  const planner::SearchParameters parameters = SearchOf(options, studio);
  const SceneSearch scene = FindSearch(*studio.held_out, studio.table, studio.own.engine.get(),
                                       parameters, kMostScenes, options.seed);
  return DrawSearch(scene, studio.table, studio.own, parameters);
}

Page MakePredictions(const Options& options, const Studio& studio) {
  const auto chains = DrawnChains(*studio.held_out, options.examples, options.seed);
  if (chains.empty()) throw model::DataError("no test trial of the data set has two actions");
  return DrawPredictions(chains, studio.table, studio.own);
}

Page Make(const std::string& name, const Options& options, const Studio& studio) {
  if (name == "predictions") return MakePredictions(options, studio);
  if (name == "reconstructions") {
    return DrawReconstructions(DrawnPictures(*studio.held_out, kPictures, options.seed),
                               studio.own);
  }
  if (name == "hidden-states") {
    return DrawHiddenStates(ChooseTrial(*studio.held_out, options.seed), studio.table, studio.own);
  }
  if (name == "random-states") return MakeRandomStates(options, studio);
  if (name == "variants") return MakeVariants(options, studio);
  if (name == "futures") return MakeFutures(options, studio);
  if (name == "search") return MakeSearch(options, studio);
  return MakeCalibration(options, studio);
}

std::string About(const Options& options, const Studio& studio) {
  return "Task " + options.task + "; weights " + fs::path(studio.weights).filename().string() +
         " (hash " + base::HexText(studio.own.engine->weights_hash()) + "), data set " +
         fs::path(options.data).filename().string() +
         ", test trials only; `./prospect figures --task " + options.task + " --seed " +
         std::to_string(options.seed) + " --trials " + std::to_string(options.trials) +
         " --samples " + std::to_string(options.samples) + "`.";
}

std::set<std::string> Wanted(const Options& options, const Studio& studio) {
  std::set<std::string> wanted(options.only.begin(), options.only.end());
  if (wanted.empty()) wanted.insert(kNames.begin(), kNames.end());
  if (studio.own.engine->info().judges) return wanted;
  for (const std::string& name : kJudging) {
    if (wanted.erase(name) > 0 && !options.only.empty()) {
      throw model::WeightsError(studio.weights + ": " + name + ": " + model::kPicturesOnly);
    }
  }
  return wanted;
}

int Main(const Options& options) {
  const base::Lock own = base::LockFolder(options.out);
  const Studio studio = OpenStudio(options);
  const std::set<std::string> wanted = Wanted(options, studio);
  std::vector<Page> pages;
  for (const std::string& name : kNames) {
    if (wanted.count(name) == 0) continue;
    pages.push_back(Make(name, options, studio));
    WritePage(options.out, pages.back());
    std::printf("%s\n", (fs::path(options.out) / pages.back().file).c_str());
    std::fflush(stdout);
  }
  WriteCaptions(options.out, About(options, studio), pages);
  return 0;
}

}  // namespace
}  // namespace prospect::figures

int main(int argc, char** argv) {
  using namespace prospect;
  figures::Options options;
  CLI::App app("Figures of what the networks keep, imagine and judge, on held-out trials.");
  figures::AddOptions(&app, &options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  return tools::RunTorchMain([&] { return figures::Main(options); }, "prospect-figures",
                             kExitTaskFailure);
}
