#include "tools/figures/drawings.h"

#include <algorithm>

#include "tools/common/progress.h"
#include "tools/figures/calibration.h"
#include "tools/figures/futures.h"
#include "tools/figures/hidden_states.h"
#include "tools/figures/predictions.h"
#include "tools/figures/random_states.h"
#include "tools/figures/search.h"
#include "tools/figures/variants.h"

namespace prospect::figures {

using report::Page;

namespace {

constexpr int kMostScenes = 40;  // looked at for one that shows something
constexpr int kChains = 4;       // examples in variants.png
constexpr int kPictures = 6;     // in reconstructions.png

planner::SearchParameters SearchOf(const cli::FiguresOptions& options, const Studio& studio) {
  planner::SearchParameters parameters;
  parameters.samples = options.samples;
  parameters.seed = options.seed;
  const model::EngineInfo& info = studio.own.engine->info();
  parameters.refusal_threshold = info.refusal_threshold;
  if (!info.calibrations.empty()) parameters.UseRule(info.calibrations.front().rule);
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

Page MakeVariants(const cli::FiguresOptions& options, const Studio& studio) {
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

Page MakeCalibration(const cli::FiguresOptions& options, const Studio& studio) {
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

Page MakeRandomStates(const cli::FiguresOptions& options, const Studio& studio) {
  const SeenTrial trial = ChooseTrial(*studio.held_out, options.seed);
  const auto first = static_cast<std::size_t>(trial.trial().first);
  return DrawRandomStates(studio.table, studio.own, trial.seen[first], options.seed);
}

Page MakeFutures(const cli::FiguresOptions& options, const Studio& studio) {
  const planner::SearchParameters parameters = SearchOf(options, studio);
  const SceneFutures scene = FindFutures(*studio.held_out, studio.table, studio.own.engine.get(),
                                         parameters, kMostScenes, options.seed);
  return DrawFutures(scene, studio.table, studio.own, parameters);
}

Page MakeSearch(const cli::FiguresOptions& options, const Studio& studio) {
  const planner::SearchParameters parameters = SearchOf(options, studio);
  const SceneSearch scene = FindSearch(*studio.held_out, studio.table, studio.own.engine.get(),
                                       parameters, kMostScenes, options.seed);
  return DrawSearch(scene, studio.table, studio.own, parameters);
}

Page MakePredictions(const cli::FiguresOptions& options, const Studio& studio) {
  const auto chains = DrawnChains(*studio.held_out, options.examples, options.seed);
  if (chains.empty()) throw model::DataError("no test trial of the data set has two actions");
  return DrawPredictions(chains, studio.table, studio.own);
}

}  // namespace

Page Draw(const std::string& name, const cli::FiguresOptions& options, const Studio& studio) {
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

}  // namespace prospect::figures
