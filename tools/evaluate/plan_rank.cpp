#include "tools/evaluate/plan_rank.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "base/number_format.h"
#include "base/random.h"
#include "base/sensor_noise.h"
#include "planner/baseline_plans.h"
#include "tools/evaluate/engine_model.h"

namespace prospect::tools {
namespace {

using nlohmann::json;
using planner::Path;

constexpr int kDrawsEach = 4;  // until enough different ones are found, or there are no more
constexpr std::uint64_t kDrawStream = 0x72616e6bULL;

Path PathOf(const model::Trial& trial) {
  Path path;
  for (int frame = 0; frame < trial.frames(); ++frame) {
    const auto at = static_cast<std::size_t>(frame);
    if (trial.segment[at] == static_cast<int>(path.size()))
      path.push_back(static_cast<std::uint8_t>(trial.actions[at]));
  }
  return path;
}

// Other beginnings of legal plans, as long as `path`, of actions whose object is there.
std::set<Path> Others(const model::Trial& trial, const planner::TaskRules& rules, const Path& path,
                      int most) {
  std::set<Path> others;
  for (int i = 0; i < kDrawsEach * most && static_cast<int>(others.size()) < most; ++i) {
    Path other = planner::RandomPlan(
        rules, {}, base::MixSeeds({trial.seed, kDrawStream, static_cast<std::uint64_t>(i)}));
    if (other.size() < path.size()) continue;
    other.resize(path.size());
    const bool there = std::all_of(other.begin(), other.end(), [&trial](std::uint8_t action) {
      return trial.present.at(action) != 0;
    });
    if (there && other != path) others.insert(std::move(other));
  }
  return others;
}

double ScoreOf(EngineModel* model, const Path& path) {
  double score = model->Predict(path).value;
  for (std::size_t k = 1; k <= path.size(); ++k) {
    const Path beginning(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(k));
    score *= model->Predict(beginning).done;
  }
  return score;
}

std::optional<PlanRank> RankOf(EngineModel* model, const model::Trial& trial,
                               const planner::TaskRules& rules, int most) {
  const Path path = PathOf(trial);
  if (path.empty() || !rules.Legal({}, path)) return std::nullopt;
  const std::set<Path> others = Others(trial, rules, path, most);
  if (others.empty()) return std::nullopt;
  const std::uint8_t* pixels = trial.frame(0);
  std::vector<std::uint8_t> first(pixels, pixels + trial.frame_bytes());
  base::AddSensorNoise(first.data(), first.size(), trial.seed, 0, trial.image_noise);
  model->SetFirst(first);
  model->SetRoot(first, trial.num_actions);
  const double own = ScoreOf(model, path);
  double less = 0;
  for (const Path& other : others) {
    const double score = ScoreOf(model, other);
    less += score < own ? 1 : score == own ? 0.5 : 0;
  }
  return PlanRank{trial.succeeded(), static_cast<int>(others.size()),
                  less / static_cast<double>(others.size())};
}

json MeanOf(const std::vector<PlanRank>& ranks, bool succeeded) {
  double sum = 0;
  int trials = 0;
  for (const PlanRank& rank : ranks) {
    if (rank.succeeded != succeeded) continue;
    sum += rank.above;
    ++trials;
  }
  return {{"trials", trials}, {"above", trials > 0 ? json(sum / trials) : json(nullptr)}};
}

std::string ShareOf(const json& kind) {
  return base::Number("%.0f %%", 100 * kind.at("above").get<double>());
}

}  // namespace

std::vector<PlanRank> RankPlans(model::Engine& engine, const model::TrialFile& file,
                                const std::vector<std::size_t>& trials,
                                const planner::TaskRules& rules, int most,
                                const std::function<void()>& progress) {
  EngineModel model(&engine);
  std::vector<PlanRank> ranks;
  for (const std::size_t i : trials) {
    if (const auto rank = RankOf(&model, file.Read(i), rules, most)) ranks.push_back(*rank);
    if (progress) progress();
  }
  return ranks;
}

json ReportOf(const std::vector<PlanRank>& ranks) {
  double others = 0;
  for (const PlanRank& rank : ranks) others += rank.others;
  return {{"succeeded", MeanOf(ranks, true)},
          {"failed", MeanOf(ranks, false)},
          {"others", others / std::max(1.0, static_cast<double>(ranks.size()))}};
}

std::string RankWords(const json& report) {
  const json &succeeded = report.at("succeeded"), &failed = report.at("failed");
  const std::string among = "Among other legal plans of its scene (" +
                            base::Number("%.0f", report.at("others").get<double>()) +
                            " drawn on average), ";
  if (succeeded.at("trials") == 0 && failed.at("trials") == 0)
    return "No recorded plan could be compared with another of its scene.\n";
  std::string text;
  if (succeeded.at("trials") > 0) text += "one that succeeded scores above " + ShareOf(succeeded);
  if (failed.at("trials") > 0)
    text += (text.empty() ? "" : ", ") + std::string("one that failed above ") + ShareOf(failed);
  return among + text + " (50 %: by chance)\n";
}

}  // namespace prospect::tools
