// prospect-calibrate-novelty: shows the networks the first pictures of calibration scenes, and
// stores in the weights how well known pictures are redrawn and where their hidden states lie. No
// physics beyond setting scenes up, no bus.

#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <memory>

#include "base/stop_signals.h"
#include "model/engine.h"
#include "model/novelty.h"
#include "sim/task_factory.h"
#include "tools/collect/collector.h"
#include "tools/common/extent.h"
#include "tools/common/progress.h"
#include "tools/common/torch_main.h"
#include "tools/evaluate/first_picture.h"
#include "tools/evaluate/scene_runs.h"

namespace prospect::tools {
namespace {

constexpr std::uint64_t kFirst = 1'500'000, kEnd = 2'000'000;

struct Options {
  std::string task = "navigation";
  std::string weights;
  std::uint64_t seed = kFirst;
  int scenes = 5000;
  CollectOptions kind;  // of scenes: as trials are made
};

void AddOptions(CLI::App* app, Options* o) {
  app->add_flag("--calibrate-novelty")->description("This program: what pictures are known");
  app->add_option("--task", o->task, "Task")->capture_default_str();
  app->add_option("--weights", o->weights, "Weights file; rewritten with the result")->required();
  app->add_option("--scenes", o->scenes,
                  "Scenes: three fifths of them for the axes, the rest for the ranks")
      ->check(CLI::Range(100, 200000))
      ->capture_default_str();
  app->add_option("--seed", o->seed, "First scene: calibration scenes are 1500000 to 1999999")
      ->check(CLI::Range(kFirst, kEnd - 1))
      ->capture_default_str();
  app->add_option("--objects", o->kind.objects,
                  "Navigation: objects on the site, 4 to 7, or mixed: half of the scenes 4, the "
                  "others 4 to 7")
      ->capture_default_str();
  app->add_option("--scene-file", o->kind.scene_file,
                  "Stacking: a file like config/scenes/stacking.yaml")
      ->check(CLI::ExistingFile);
}

std::vector<model::NoveltySample> Samples(const Options& options, model::Engine* engine) {
  std::map<int, std::unique_ptr<sim::Task>> tasks;  // by objects
  std::vector<model::NoveltySample> samples;
  Progress progress("scenes", options.scenes);
  base::InstallStopSignals();
  for (int i = 0; i < options.scenes; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    const sim::TaskOptions scene = SceneOptions(options.kind, seed);
    auto& task = tasks[scene.objects];
    if (!task) task = sim::MakeTask(options.task, scene);
    const auto picture = FirstPicture(*task, seed, scene.image_noise);
    samples.push_back(model::TakeNoveltySample(*engine, picture));
    progress.Step();
    if (base::StopRequested()) break;
  }
  const Extent extent{static_cast<int>(samples.size()), options.scenes};
  if (extent.stopped()) throw Interrupted(extent.Words("scenes") + "; nothing was stored");
  return samples;
}

int Main(int argc, char** argv) {
  Options options;
  options.kind.objects = "mixed";
  CLI::App app("Stores in the weights what the first pictures of known scenes look like to them");
  AddOptions(&app, &options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (options.seed + static_cast<std::uint64_t>(options.scenes) > kEnd)
    throw std::invalid_argument("calibration scenes are 1500000 to 1999999: see --seed, --scenes");
  options.kind.task = options.task;
  RequireWeightsOf(options.task, options.weights);
  const auto engine = model::LoadTorchEngine(options.weights, 1);
  const auto samples = Samples(options, engine.get());

  const auto middle = samples.begin() + options.scenes * 3 / 5;
  const model::NoveltyGauge gauge({samples.begin(), middle}, {middle, samples.end()});
  model::NoveltySource source;
  source.first_seed = options.seed;
  source.fitted = options.scenes * 3 / 5;
  source.ranked = options.scenes - source.fitted;
  source.command = "prospect-calibrate-novelty --task " + options.task + " --scenes " +
                   std::to_string(options.scenes) + " --seed " + std::to_string(options.seed) +
                   " --objects " + options.kind.objects;
  model::StoreNovelty(options.weights, gauge, source);
  const model::Novelty limits = gauge.Judge(samples.back());
  std::cout << "99 % of known pictures: error below " << limits.error_limit
            << ", residual's distance below " << limits.residual_limit << ", hidden state's below "
            << limits.state_limit << "; from " << source.fitted << " + " << source.ranked
            << " scenes, stored in " << options.weights << "\n";
  const double least = 2.0 / (source.ranked + 1);
  if (least >= model::kNoveltyLevel) {
    std::cerr << "prospect-calibrate-novelty: with so few scenes no picture gets a p-value below "
              << least << ", so none is refused by default: take 500 or more\n";
  }
  return 0;
}

}  // namespace
}  // namespace prospect::tools

int main(int argc, char** argv) {
  return prospect::tools::RunTorchMain([&] { return prospect::tools::Main(argc, argv); },
                                       "prospect-calibrate-novelty");
}
