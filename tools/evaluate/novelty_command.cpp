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
#include "tools/common/words.h"
#include "tools/evaluate/commands.h"
#include "tools/evaluate/first_picture.h"
#include "tools/evaluate/scene_runs.h"

namespace prospect::tools {
namespace {

std::vector<model::NoveltySample> Samples(const cli::NoveltyOptions& options,
                                          model::Engine* engine) {
  cli::TrialSceneOptions kind;  // of scenes: as trials are made
  kind.objects = options.objects;
  kind.scene_file = options.scene_file;
  std::map<int, std::unique_ptr<sim::Task>> tasks;  // by objects
  std::vector<model::NoveltySample> samples;
  Progress progress("scenes", options.scenes);
  base::InstallStopSignals();
  for (int i = 0; i < options.scenes; ++i) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    const sim::TaskOptions scene = SceneOptions(kind, seed);
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

model::NoveltySource SourceOf(const cli::NoveltyOptions& options) {
  model::NoveltySource source;
  source.first_seed = options.seed;
  source.fitted = options.scenes * 3 / 5;
  source.ranked = options.scenes - source.fitted;
  source.command = "./prospect evaluate novelty --task " + options.task + " --scenes " +
                   std::to_string(options.scenes) + " --seed " + std::to_string(options.seed) +
                   " --objects " + options.objects;
  return source;
}

void WarnOfFew(const model::NoveltySource& source) {
  const double least = 2.0 / (source.ranked + 1);
  if (least < model::kNoveltyLevel) return;
  std::cerr << "prospect-evaluate: with so few scenes no picture gets a p-value below " << least
            << ", so none is refused by default: take 500 or more\n";
}

}  // namespace

int RunNovelty(const cli::NoveltyOptions& options) {
  const std::string weights = cli::WeightsFile(options.weights, options.task);
  RequireWeightsOf(options.task, weights);
  const auto engine = model::LoadEngine(weights, 1);
  const auto samples = Samples(options, engine.get());
  const model::NoveltySource source = SourceOf(options);
  const auto middle = samples.begin() + source.fitted;
  const model::NoveltyGauge gauge({samples.begin(), middle}, {middle, samples.end()});
  model::StoreNovelty(weights, gauge, source);
  const model::Novelty limits = gauge.Judge(samples.back());
  Words() << "99 % of known pictures: error below " << limits.error_limit
          << ", residual's distance below " << limits.residual_limit << ", hidden state's below "
          << limits.state_limit << "; from " << source.fitted << " + " << source.ranked
          << " scenes, stored in " << weights << "\n";
  WarnOfFew(source);
  return 0;
}

}  // namespace prospect::tools
