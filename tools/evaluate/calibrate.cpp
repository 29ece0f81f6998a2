#include "tools/evaluate/calibrate.h"

#include <algorithm>
#include <iostream>
#include <optional>

#include "base/number_format.h"
#include "model/refusal/risk_coverage.h"
#include "tools/common/words.h"
#include "tools/evaluate/simulated_world.h"

namespace prospect::tools {
namespace {

using model::SceneClass;
using model::SceneEnding;

SceneClass ClassFrom(const std::string& name) {
  if (name == "solvable") return SceneClass::kSolvable;
  if (name == "hopeless") return SceneClass::kHopeless;
  if (name == "doubtful") return SceneClass::kDoubtful;
  throw std::invalid_argument("unknown class '" + name + "' in a record");
}

SceneEnding EndingFrom(const std::string& name) {
  if (name == "solved") return SceneEnding::kSolved;
  if (name == "failed") return SceneEnding::kFailed;
  if (name == "stopped") return SceneEnding::kStopped;
  if (name == "refused") return SceneEnding::kRefused;
  throw std::invalid_argument("unknown ending '" + name + "' in a record");
}

// A refused scene's score is that of a future that was given up: it says nothing.
model::CalibrationScene SceneFrom(const SceneRecord& record) {
  const auto& row = record.at("rows").at("planner");
  model::CalibrationScene scene;
  scene.scene_class = ClassFrom(record.at("class"));
  scene.ending = EndingFrom(row.at("ending"));
  if (scene.attempted()) scene.score = std::clamp(row.at("score").get<double>(), 0.0, 1.0);
  return scene;
}

// The lowest threshold at which of this sample no more failed than was asked: what so few trials
// can say where they promise nothing.
std::optional<model::ThresholdEffect> LeastThatSeemed(const model::CalibrationSample& sample,
                                                      double fail_at_most) {
  std::optional<model::ThresholdEffect> least;
  for (const model::ThresholdEffect& effect : model::RiskCoverageCurve(sample)) {
    if (effect.risk <= fail_at_most) least = effect;
  }
  return least;
}

std::string SeenWords(const std::optional<model::ThresholdEffect>& seen) {
  if (!seen) return "At no threshold did so few fail as was asked, so all is refused.";
  return "In its place, and without a promise, the threshold is the lowest at which so few "
         "failed: " +
         base::Fixed(seen->threshold, 3) + ", with " + std::to_string(seen->failed) + " of " +
         std::to_string(seen->attempted) + " attempted; more held-out trials can promise it.";
}

void Tell(const std::vector<std::string>& words) {
  for (const std::string& sentence : words) Words() << sentence << "\n";
}

}  // namespace

model::Promise PromiseOf(const cli::PromiseOptions& options) {
  model::Promise promise;
  promise.refuse_at_most = options.refuse_at_most;
  promise.fail_at_most = options.fail_at_most;
  promise.delta = options.delta;
  return promise;
}

model::CalibrationSample SampleFrom(const std::vector<SceneRecord>& scenes) {
  model::CalibrationSample sample;
  try {
    for (const SceneRecord& record : scenes) {
      if (!record.at("solved_at_start").get<bool>()) sample.scenes.push_back(SceneFrom(record));
    }
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(std::string("a record is not one of a scene: ") + error.what());
  }
  std::stable_sort(sample.scenes.begin(), sample.scenes.end(),
                   [](const auto& a, const auto& b) { return a.score < b.score; });
  return sample;
}

model::SceneKind KindOf(const sim::Task& task) {
  const agent::SceneLabel label = SceneLabelOf(task, 0);
  return agent::KindOf(TaskViewOf(task.spec()), &label);
}

std::map<std::string, double> CoveredParameters(const planner::SearchParameters& search,
                                                const model::SceneKind& kind, int retries) {
  return {{"samples", static_cast<double>(search.samples)},
          {"c", search.c},
          {"c_done", search.c_done},
          {"v_failed", search.v_failed},
          {"p_min", search.p_min},
          {"plan_length", kind.plan_length},
          {"objects", kind.objects},
          {"retries", retries}};
}

model::Calibration CalibrationFrom(const model::CalibrationSample& sample,
                                   const model::Promise& promise, const std::string& command,
                                   std::vector<std::string>* words) {
  const model::PromisedThreshold promised = model::ThresholdFor(sample, promise);
  *words = promised.words;
  model::Calibration calibration;
  calibration.alpha = promise.refuse_at_most;
  calibration.delta = promise.delta;
  if (promised.may_attempt) {
    calibration.refusal_threshold = promised.value;
    calibration.epsilon = promise.fail_at_most;
  } else {
    const auto seen = LeastThatSeemed(sample, *promise.fail_at_most);
    calibration.refusal_threshold = seen ? seen->threshold : 1;
    words->push_back(SeenWords(seen));
  }
  calibration.scenes = static_cast<int>(
      std::count_if(sample.scenes.begin(), sample.scenes.end(),
                    [](const auto& scene) { return scene.scene_class == SceneClass::kSolvable; }));
  calibration.command = command;
  calibration.sample = sample;
  return calibration;
}

std::string HeedCoverage(const std::string& weights, const model::SceneKind& kind,
                         double* threshold) {
  const auto samples = model::SamplesOf(model::CalibrationsOf(weights));
  const std::string words = model::NotCovered(samples, kind);
  if (words.empty()) {
    const model::CalibrationSample* covering = model::CoveringSample(samples, kind);
    if (*threshold < 0 && covering != nullptr) *threshold = covering->refusal_threshold;
    return words;
  }
  std::cerr << words << "\n";
  if (*threshold >= 0) return words;
  std::cerr << "Their own refusal threshold does not hold either: here nothing is refused for its "
               "score (an executive would refuse all of it); --threshold sets another.\n";
  *threshold = 0;
  return words;
}

double PromisedThresholdOf(const std::string& weights, const model::Promise& promise,
                           const model::SceneKind& kind) {
  const auto samples = model::SamplesOf(model::CalibrationsOf(weights));
  if (samples.empty()) {
    throw PromiseError(weights +
                       ": carries no calibration sample to choose a threshold by: make one with "
                       "./prospect evaluate calibrate");
  }
  const std::string not_covered = model::NotCovered(samples, kind);
  if (!not_covered.empty()) throw PromiseError("nothing can be promised: " + not_covered);
  const model::CalibrationSample& sample = *model::CoveringSample(samples, kind);
  const model::PromisedThreshold promised = model::ThresholdFor(sample, promise);
  Tell(promised.words);
  if (!promised.kept) Words() << model::CurveTable(sample);
  if (!promised.may_attempt)
    throw PromiseError("nothing may be attempted: " + promised.words.back());
  return promised.value;
}

}  // namespace prospect::tools
