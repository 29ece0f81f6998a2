#include "tools/evaluate/recorded.h"

#include <algorithm>

#include "base/number_format.h"
#include "base/stop_signals.h"
#include "model/weights_file.h"
#include "planner/search_parameters.h"
#include "tools/common/progress.h"
#include "tools/common/words.h"

namespace prospect::tools {
namespace {

constexpr std::size_t kFewestPictures = 16;  // of either part of a gauge

// Whoever learned a trial's outcome by heart judges it too well.
void RequireUnseen(const model::TrialFile& file, const std::string& weights) {
  const std::string trained = model::ReadWeights(weights).metadata.value("data_hash", "");
  if (trained != file.ContentHash()) return;
  throw model::DataError(file.path() +
                         ": these weights were trained on its train part: leave --all-trials out");
}

}  // namespace

model::GivenUpBelow GivenUpBy(const std::string& rule) {
  planner::SearchParameters search;
  search.UseRule(rule);
  return {search.c_done, search.v_failed, search.p_min};
}

Recorded JudgeData(const std::string& data, const std::string& weights, const std::string& rule,
                   bool all) {
  const model::TrialFile file(data);
  if (all) RequireUnseen(file, weights);
  const std::vector<std::size_t> trials = model::HeldOutTrials(file, all);
  if (trials.empty()) {
    throw model::DataError(data + ": none of its " + std::to_string(file.size()) +
                           " trials is held out: record more, or say --all-trials where none was "
                           "trained on");
  }
  const auto engine = model::LoadSearchEngine(weights, 1);
  Progress progress("trials", static_cast<int>(trials.size()));
  base::InstallStopSignals();
  const auto step = [&] {
    progress.Step();
    if (base::StopRequested()) throw ExitError(kExitInterrupted, "stopped; nothing was stored");
  };
  return {weights, model::JudgeRecorded(*engine, file, trials, GivenUpBy(rule), step)};
}

std::string StoreRecordedNovelty(const Recorded& recorded, const std::string& command) {
  std::vector<model::NoveltySample> samples;
  for (const model::RecordedTrial& trial : recorded.judged.trials) samples.push_back(trial.first);
  model::NoveltySource source;
  source.first_seed = recorded.judged.trials.front().seed;
  source.fitted = static_cast<int>(samples.size() * 2 / 5);
  source.ranked = static_cast<int>(samples.size()) - source.fitted;
  source.command = command;
  const auto middle = samples.begin() + source.fitted;
  if (std::min<std::size_t>(static_cast<std::size_t>(source.fitted), samples.size() / 2) <
      kFewestPictures)
    return "Too few trials to tell known pictures from others: 40 are wanted.";
  model::StoreNovelty(recorded.weights,
                      model::NoveltyGauge({samples.begin(), middle}, {middle, samples.end()}),
                      source);
  const double least = 2.0 / (source.ranked + 1);
  return "Known pictures: " + std::to_string(samples.size()) + " first pictures" +
         (least < model::kNoveltyLevel
              ? "."
              : "; with so few none gets a p-value below " + base::Number("%.3f", least) +
                    ", so by default none is refused as unlike them (500 are enough).");
}

}  // namespace prospect::tools
