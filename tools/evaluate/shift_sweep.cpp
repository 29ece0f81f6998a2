#include "tools/evaluate/shift_sweep.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "agent/episode.h"
#include "tools/common/interval.h"
#include "tools/evaluate/episode.h"
#include "tools/evaluate/search_deciders.h"
#include "tools/evaluate/simulated_world.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

constexpr int kEnough = 30;  // attempts from which on a share of failures is judged
constexpr double kMostFailures = 0.2;

sim::TaskOptions Shifted(const sim::TaskOptions& world, const ShiftPoint& point) {
  sim::TaskOptions options = world;
  if (point.strength > 0) sim::SetShift(point.factor, point.strength, &options);
  return options;
}

json PointSummary(const std::vector<json>& scenes, const ShiftPoint& point) {
  int solved = 0, refused = 0, failed = 0, unlike = 0;
  for (const json& scene : scenes) {
    const json& record = scene.at("points").at(point.Name());
    const std::string ending = record.at("ending");
    ++(ending == "solved" ? solved : ending == "refused" ? refused : failed);
    unlike += record.at("unlike").get<bool>();
  }
  const Share share = ShareOf(failed, solved + failed);
  json summary = {{"name", point.Name()},
                  {"factor", point.factor},
                  {"strength", point.strength},
                  {"scenes", scenes.size()},
                  {"solved", solved},
                  {"refused", refused},
                  {"failed", failed},
                  {"unlike", unlike},
                  {"failed_share", share.value},
                  {"failed_share_interval", {share.low, share.high}},
                  {"met", nullptr}};
  if (point.strength > 0) {
    summary["amount"] = sim::ShiftAmount(point.factor, point.strength);
    summary["what"] = sim::ShiftText(point.factor, point.strength);
  }
  if (solved + failed >= kEnough) summary["met"] = share.value <= kMostFailures;
  return summary;
}

}  // namespace

std::string ShiftPoint::Name() const {
  return strength == 0 ? "none" : factor + " " + std::to_string(strength);
}

std::vector<ShiftPoint> ShiftPoints(const std::vector<std::string>& factors) {
  std::vector<ShiftPoint> points = {{}};
  for (const std::string& factor : factors) {
    for (int strength = 1; strength <= sim::kShiftStrengths; ++strength) {
      sim::ShiftAmount(factor, strength);  // throws for an unknown one
      points.push_back({factor, strength});
    }
  }
  return points;
}

ShiftSweep::ShiftSweep(const SweepOptions& options)
    : options_(options),
      engine_(model::LoadDecidingEngine(options.weights, 1)),
      gauge_(model::NoveltyGauge::Load(options.weights)),
      world_(sim::MakeTask(options.task, options.world)) {
  for (const ShiftPoint& point : options_.points)
    looking_.push_back(sim::MakeTask(options_.task, Shifted(options_.world, point)));
}

json ShiftSweep::Run(std::uint64_t scene_seed) {
  ends_.clear();
  json record = {{"seed", scene_seed}, {"points", json::object()}};
  for (std::size_t i = 0; i < options_.points.size(); ++i)
    record["points"][options_.points[i].Name()] = RunPoint(scene_seed, i);
  return record;
}

agent::EpisodeRecord ShiftSweep::LookAndPlan(std::uint64_t scene_seed, std::size_t point) {
  auto planner = MakeLearned(PlanBy::kSearch, engine_.get(), options_.search);
  // How unlike the known ones a picture is is told in any case; no p-value lies below this.
  const double level = std::max(options_.novelty_level, std::numeric_limits<double>::min());
  if (gauge_) planner = MakeNoveltyGate(std::move(planner), engine_.get(), *gauge_, level);
  planner->options.explain_only = true;
  const double noise = Shifted(options_.world, options_.points[point]).image_noise;
  SimulatedWorld world(*looking_[point], scene_seed, noise);
  planner->mind->Enter(*looking_[point], scene_seed);
  agent::Listener nobody;
  return agent::Episode(world, planner->mind.get(), planner->options, nobody).Run();
}

json ShiftSweep::RunPoint(std::uint64_t scene_seed, std::size_t point) {
  const agent::EpisodeRecord seen = LookAndPlan(scene_seed, point);
  const agent::SearchRecord& search = seen.searches.front();
  json record = {{"ending", "refused"},
                 {"reason", search.reason},
                 {"score", search.score},
                 {"unlike", seen.familiarity && seen.familiarity->foreign()},
                 {"p", nullptr}};
  if (seen.familiarity) record["p"] = seen.familiarity->novelty.p;
  if (!search.act) return record;
  std::vector<int> plan;
  for (const agent::StepRecord& step : search.steps) plan.push_back(step.action);
  const End& end = CarryOut(scene_seed, plan);
  record["plan"] = plan;
  record["ending"] = end.ending;
  record["reason"] = end.reason;
  return record;
}

const ShiftSweep::End& ShiftSweep::CarryOut(std::uint64_t scene_seed,
                                            const std::vector<int>& plan) {
  const auto known = ends_.find(plan);
  if (known != ends_.end()) return known->second;
  const EpisodeRecord episode = RunGivenPlan(*world_, plan, scene_seed);
  return ends_[plan] = {ToString(episode.ending), episode.reason};
}

json SummariseShifts(const std::vector<json>& scenes, const std::vector<ShiftPoint>& points) {
  json summary = {{"scenes", scenes.size()}, {"points", json::array()}};
  for (const ShiftPoint& point : points) summary["points"].push_back(PointSummary(scenes, point));
  return summary;
}

std::string ShiftTable(const json& summary) {
  std::string text =
      "shift                          solved refused  (unlike)  failed   of attempted, 95 % "
      "interval\n";
  for (const json& point : summary.at("points")) {
    char line[200];
    const json& interval = point.at("failed_share_interval");
    const int attempted = point.at("solved").get<int>() + point.at("failed").get<int>();
    std::snprintf(line, sizeof line, "%-30s %6d %7d %9d %7d   ",
                  point.value("what", std::string("none")).c_str(), point.at("solved").get<int>(),
                  point.at("refused").get<int>(), point.at("unlike").get<int>(),
                  point.at("failed").get<int>());
    text += line;
    if (attempted == 0) {
      text += "nothing was attempted\n";
      continue;
    }
    std::snprintf(line, sizeof line, "%5.1f %% [%4.1f, %4.1f]%s\n",
                  100 * point.at("failed_share").get<double>(), 100 * interval[0].get<double>(),
                  100 * interval[1].get<double>(),
                  point.at("met").is_null()     ? "  few attempted"
                  : point.at("met").get<bool>() ? ""
                                                : "  above 20 %");
    text += line;
  }
  return text;
}

}  // namespace prospect::tools
