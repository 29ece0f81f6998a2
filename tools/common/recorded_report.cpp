#include "tools/common/recorded_report.h"

#include <algorithm>
#include <cstdio>

#include "base/number_format.h"
#include "cli/options/task.h"
#include "model/refusal/isotonic.h"
#include "model/training/measures.h"
#include "model/training/verdict.h"

namespace prospect::tools {
namespace {

using model::Judgements;
using nlohmann::json;

constexpr int kReliabilityBlocks = 6;  // at most, so that each holds some trials

json HeadOf(const Judgements& judgements) {
  const double rate = model::BaseRate(judgements);
  return {{"samples", judgements.size()},
          {"base_rate", rate},
          {"area_under_roc", model::AreaUnderRoc(judgements)},
          {"balanced_accuracy", model::BalancedAccuracy(judgements, 0.5)},
          {"brier", model::BrierScore(judgements)},
          {"trivial_brier", rate * (1 - rate)}};
}

// A plan that is given up scores nothing.
Judgements PlansOf(const model::RecordedTrials& judged) {
  Judgements plans;
  for (const model::RecordedTrial& trial : judged.trials)
    plans.push_back({trial.given_up ? 0 : static_cast<float>(trial.score), trial.succeeded});
  return plans;
}

json FOf(const model::RecordedTrials& judged, const std::vector<std::string>& names) {
  Judgements one, ahead;
  std::vector<Judgements> by_action(names.size());
  for (const model::RecordedTrial& trial : judged.trials) {
    for (const model::RecordedStep& step : trial.steps) {
      one.push_back({step.done, step.succeeded});
      ahead.push_back({step.done_ahead, step.succeeded});
      by_action.at(static_cast<std::size_t>(step.action)).push_back(one.back());
    }
  }
  json actions = json::array();
  for (std::size_t a = 0; a < names.size(); ++a) {
    actions.push_back(HeadOf(by_action[a]));
    actions.back()["name"] = names[a];
  }
  return {{"one", HeadOf(one)}, {"ahead", HeadOf(ahead)}, {"actions", actions}};
}

json ReliabilityOf(const model::CalibrationSample& sample) {
  const int fewest = std::max(5, static_cast<int>(sample.scenes.size()) / kReliabilityBlocks);
  json blocks = json::array();
  const model::SuccessCurve curve(sample, fewest);
  for (const model::SuccessBlock& block : curve.blocks()) {
    blocks.push_back({{"low", block.low},
                      {"high", block.high},
                      {"trials", block.scenes},
                      {"succeeded", block.solved}});
  }
  return blocks;
}

json PictureOf(const model::ImaginedError& error) {
  return {{"pictures", error.pictures},
          {"mae", error.all},
          {"copy_mae", error.copied},
          {"mae_changed", error.changed},
          {"copy_mae_changed", error.copied_changed}};
}

json NoveltyOf(const model::RecordedTrials& judged,
               const std::optional<model::NoveltyGauge>& gauge) {
  if (!gauge) return nullptr;
  std::size_t refused = 0;
  for (const model::RecordedTrial& trial : judged.trials)
    refused += gauge->Judge(trial.first).p < model::kNoveltyLevel;
  return {{"level", model::kNoveltyLevel}, {"below", refused}, {"ranked", gauge->ranked()}};
}

std::string ReliabilityWords(const json& report) {
  std::string text = "Plans by score, and how many of them succeeded:\n";
  for (const json& block : report.at("reliability")) {
    char line[100];
    const int trials = block["trials"], succeeded = block["succeeded"];
    std::snprintf(line, sizeof line, "  %5.3f to %5.3f %6d trials %6d succeeded (%.0f %%)\n",
                  block["low"].get<double>(), block["high"].get<double>(), trials, succeeded,
                  100.0 * succeeded / std::max(1, trials));
    text += line;
  }
  const int given_up = report.at("given_up"), lost = report.at("given_up_succeeded");
  return text + "  given up by a search: " + std::to_string(given_up) + ", of which " +
         std::to_string(lost) + " succeeded\n";
}

std::string NoveltyWords(const json& report) {
  const json& novelty = report.at("novelty");
  if (novelty.is_null())
    return "The weights hold nothing of known pictures: none would be refused as unlike them.\n";
  return "First pictures that would be refused as unlike the known ones: " +
         std::to_string(novelty["below"].get<int>()) + " of " +
         std::to_string(report["trials"].get<int>()) + "\n";
}

}  // namespace

std::vector<std::string> ActionNames(const std::string& task) {
  std::vector<std::string> names;
  for (const sim::ActionSpec& action : cli::TaskOf(task).spec.actions) names.push_back(action.name);
  return names;
}

model::CalibrationSample SampleOf(const model::RecordedTrials& judged) {
  model::CalibrationSample sample;
  for (const model::RecordedTrial& trial : judged.trials) {
    model::CalibrationScene scene;
    scene.scene_class =
        trial.succeeded ? model::SceneClass::kSolvable : model::SceneClass::kDoubtful;
    scene.ending = trial.given_up    ? model::SceneEnding::kRefused
                   : trial.succeeded ? model::SceneEnding::kSolved
                                     : model::SceneEnding::kFailed;
    scene.score = trial.given_up ? 0 : trial.score;
    sample.scenes.push_back(scene);
  }
  std::stable_sort(sample.scenes.begin(), sample.scenes.end(),
                   [](const auto& a, const auto& b) { return a.score < b.score; });
  return sample;
}

json ReportOf(const model::RecordedTrials& judged, const std::vector<std::string>& names,
              const std::optional<model::NoveltyGauge>& gauge) {
  int succeeded = 0, given_up = 0, lost = 0;
  for (const model::RecordedTrial& trial : judged.trials) {
    succeeded += trial.succeeded;
    given_up += trial.given_up;
    lost += trial.given_up && trial.succeeded;
  }
  return {{"trials", judged.trials.size()},
          {"succeeded", succeeded},
          {"given_up", given_up},
          {"given_up_succeeded", lost},
          {"plan", HeadOf(PlansOf(judged))},
          {"reliability", ReliabilityOf(SampleOf(judged))},
          {"f", FOf(judged, names)},
          {"pictures", {{"x1", PictureOf(judged.after_one)}, {"x2", PictureOf(judged.after_two)}}},
          {"novelty", NoveltyOf(judged, gauge)}};
}

std::string RecordedWords(const json& report) {
  std::string text = "On " + std::to_string(report.at("trials").get<int>()) + " recorded trials, " +
                     std::to_string(report.at("succeeded").get<int>()) + " of which succeeded:\n";
  const json& pictures = report.at("pictures");
  text += model::PictureVerdict("pictures after one action", pictures.at("x1"));
  text += model::PictureVerdict("pictures after two", pictures.at("x2"));
  text += model::HeadVerdict("f, one action ahead", report.at("f").at("one"));
  text += model::HeadVerdict("f, from the first picture", report.at("f").at("ahead"));
  text += model::HeadVerdict("whole plans, V times f", report.at("plan"));
  text += "A plan that succeeded scores above one that failed in " +
          base::Number("%.0f %%", 100 * report.at("plan").at("area_under_roc").get<double>()) +
          " of pairs (50 %: by chance)\n";
  return text + ReliabilityWords(report) + model::ActionVerdict(report.at("f").at("actions")) +
         NoveltyWords(report);
}

}  // namespace prospect::tools
