#include "tools/evaluate/plan_scores.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "base/sensor_noise.h"
#include "model/training/measures.h"
#include "sim/rollout.h"
#include "tools/evaluate/engine_model.h"

namespace prospect::tools {
namespace {

using nlohmann::json;
using planner::Path;
using Scenes = std::vector<const PlanScene*>;
using Figure = std::function<double(const Scenes&)>;

constexpr int kResamples = 1000;
constexpr double kOften = 0.5;

// --- one scene

json Expectation(EngineModel& model, const PlanOutcome& outcome, int runs) {
  json score = json::array(), value = json::array(), done = json::array();
  double all_done = 1;
  for (std::size_t length = 1; length <= outcome.plan.size(); ++length) {
    const Path begun(outcome.plan.begin(), outcome.plan.begin() + static_cast<long>(length));
    const planner::Evaluation e = model.Evaluate(begun);
    all_done *= e.done;
    value.push_back(e.value);
    done.push_back(e.done);
    score.push_back(all_done * e.value);
  }
  return {{"plan", outcome.plan},
          {"frequency", static_cast<double>(outcome.successes) / runs},
          {"again", static_cast<double>(outcome.again) / runs},
          {"score", score},
          {"value", value},
          {"done", done}};
}

double Error(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(static_cast<int>(a[i]) - b[i]);
  return sum / (255.0 * static_cast<double>(a.size()));
}

// Goes through the plans' beginnings as the trial's own run has them, and compares wherever an
// action succeeded.
class Pictures {
 public:
  Pictures(sim::Task& task, model::Engine& engine, EngineModel& model,
           const std::vector<std::uint8_t>& seen)
      : task_(task), engine_(engine), model_(model), seen_(seen) {}

  json Compare(const std::vector<PlanOutcome>& outcomes) {
    for (const PlanOutcome& outcome : outcomes) plans_.insert(outcome.plan);
    Explore({});
    return found_;
  }

 private:
  bool Wanted(const Path& begun) const {
    const auto at = plans_.lower_bound(begun);
    return at != plans_.end() && at->size() >= begun.size() &&
           std::equal(begun.begin(), begun.end(), at->begin());
  }

  void Explore(const Path& begun) {
    const std::unique_ptr<sim::TaskState> here = task_.Save();
    for (const int action : task_.LegalActions()) {
      Path next = begun;
      next.push_back(static_cast<std::uint8_t>(action));
      if (!Wanted(next)) continue;
      sim::RunAction(task_, action, nullptr);
      if (task_.progress().outcome != sim::Outcome::kFailure) Note(next);
      if (task_.progress().outcome == sim::Outcome::kRunning) Explore(next);
      task_.Restore(*here);
    }
  }

  void Note(const Path& path) {
    const std::vector<std::uint8_t> truth = task_.Observe().rgb;
    const auto imagined =
        engine_.DecodeOnto(seen_, model_.Predict({}).h, {model_.Predict(path).h}).at(0);
    found_.push_back(
        {{"depth", path.size()}, {"error", Error(imagined, truth)}, {"copy", Error(seen_, truth)}});
  }

  sim::Task& task_;
  model::Engine& engine_;
  EngineModel& model_;
  const std::vector<std::uint8_t>& seen_;
  std::set<Path> plans_;
  json found_ = json::array();
};

// --- figures over scenes

std::vector<double> Ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last < order.size() && values[order[last]] == values[order[first]]) ++last;
    for (std::size_t i = first; i < last; ++i)
      ranks[order[i]] = 0.5 * static_cast<double>(first + last - 1);
    first = last;
  }
  return ranks;
}

// How a plan is judged: its score after `depth` actions (0: all), or how it fared in other runs.
using Judge = std::function<double(const json& plan)>;

Judge ScoreAfter(std::size_t depth) {
  return [depth](const json& plan) {
    const json& score = plan.at("score");
    return score.at(depth == 0 ? score.size() - 1 : depth - 1).get<double>();
  };
}

double Again(const json& plan) { return plan.at("again").get<double>(); }

double MeanCorrelation(const Scenes& scenes, const Judge& judge) {
  double sum = 0;
  int count = 0;
  for (const PlanScene* scene : scenes) {
    std::vector<double> judged, truth;
    for (const json& plan : scene->at("plans")) {
      judged.push_back(judge(plan));
      truth.push_back(plan.at("frequency"));
    }
    const double rho = RankCorrelation(judged, truth);
    const bool spread = *std::max_element(truth.begin(), truth.end()) >
                        *std::min_element(truth.begin(), truth.end());
    if (!spread) continue;
    // Who gives all plans one score has not ranked them.
    sum += std::isnan(rho) ? 0 : rho;
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

double Area(const Scenes& scenes, const Judge& judge) {
  model::Judgements judgements;
  for (const PlanScene* scene : scenes) {
    for (const json& plan : scene->at("plans")) {
      judgements.push_back({static_cast<float>(judge(plan)), plan.at("frequency") >= kOften});
    }
  }
  return model::AreaUnderRoc(judgements);
}

// The figure, and where 95 % of those of resampled scenes lie.
json WithInterval(const Scenes& scenes, const Figure& figure) {
  std::mt19937_64 random(1);
  std::vector<double> values;
  for (int i = 0; i < kResamples; ++i) {
    Scenes sample;
    for (std::size_t k = 0; k < scenes.size(); ++k)
      sample.push_back(scenes[random() % scenes.size()]);
    const double value = figure(sample);
    if (!std::isnan(value)) values.push_back(value);
  }
  std::sort(values.begin(), values.end());
  const double value = figure(scenes);
  if (values.empty() || std::isnan(value)) return nullptr;
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return {{"value", value}, {"interval", {at(0.025), at(0.975)}}};
}

json Ranking(const Scenes& scenes, const Judge& judge) {
  return {{"rho", WithInterval(scenes, [&](const Scenes& s) { return MeanCorrelation(s, judge); })},
          {"auroc", WithInterval(scenes, [&](const Scenes& s) { return Area(s, judge); })}};
}

json PictureErrors(const Scenes& scenes, std::size_t depth) {
  double error = 0, copy = 0;
  int count = 0;
  for (const PlanScene* scene : scenes) {
    for (const json& picture : scene->at("pictures")) {
      if (picture.at("depth") != depth) continue;
      error += picture.at("error").get<double>();
      copy += picture.at("copy").get<double>();
      ++count;
    }
  }
  if (count == 0) return nullptr;
  return {{"count", count}, {"error", error / count}, {"copy", copy / count}};
}

std::string Cell(const json& figure) {
  if (figure.is_null()) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.3f (%.3f-%.3f)", figure["value"].get<double>(),
                figure["interval"][0].get<double>(), figure["interval"][1].get<double>());
  return text;
}

std::string Line(const std::string& name, const json& ranking, const json& pictures) {
  char text[256];
  const std::string error =
      pictures.is_null() ? "-" : std::to_string(pictures["error"].get<double>()).substr(0, 6);
  const std::string copy =
      pictures.is_null() ? "-" : std::to_string(pictures["copy"].get<double>()).substr(0, 6);
  std::snprintf(text, sizeof text, "%-16s %-22s %-22s %8s %12s\n", name.c_str(),
                Cell(ranking["rho"]).c_str(), Cell(ranking["auroc"]).c_str(), error.c_str(),
                copy.c_str());
  return text;
}

}  // namespace

double RankCorrelation(const std::vector<double>& x, const std::vector<double>& y) {
  const std::vector<double> a = Ranks(x), b = Ranks(y);
  const double mean = 0.5 * (static_cast<double>(x.size()) - 1);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean) * (b[i] - mean);
    aa += (a[i] - mean) * (a[i] - mean);
    bb += (b[i] - mean) * (b[i] - mean);
  }
  if (aa == 0 || bb == 0) return std::numeric_limits<double>::quiet_NaN();
  return ab / std::sqrt(aa * bb);
}

PlanScene ScorePlans(sim::Task& task, model::Engine& engine, std::uint64_t scene_seed,
                     double image_noise, const std::vector<PlanOutcome>& outcomes, int runs) {
  task.Reset(scene_seed);
  std::vector<std::uint8_t> seen = task.Observe().rgb;
  base::AddSensorNoise(seen.data(), seen.size(), scene_seed, 0, image_noise);
  EngineModel model(&engine);
  model.SetFirst(seen);
  model.SetRoot(seen, task.spec().null_action());
  PlanScene scene = {{"seed", scene_seed}, {"plans", json::array()}};
  for (const PlanOutcome& outcome : outcomes)
    scene["plans"].push_back(Expectation(model, outcome, runs));
  scene["pictures"] = Pictures(task, engine, model, seen).Compare(outcomes);
  return scene;
}

json SummarisePlans(const std::vector<PlanScene>& scenes) {
  Scenes all;
  std::size_t depth = 0, plans = 0;
  int spread = 0;
  for (const PlanScene& scene : scenes) {
    if (scene.at("plans").empty()) continue;
    all.push_back(&scene);
    plans += scene["plans"].size();
    depth = std::max(depth, scene["plans"][0]["score"].size());
    std::set<double> frequencies;
    for (const json& plan : scene["plans"]) frequencies.insert(plan["frequency"].get<double>());
    spread += frequencies.size() > 1;
  }
  json summary = {{"scenes", all.size()}, {"plans", plans}, {"scenes_with_spread", spread}};
  if (all.empty()) return summary;
  summary["ranking"] = Ranking(all, ScoreAfter(0));
  summary["ceiling"] = Ranking(all, Again);
  for (std::size_t d = 1; d <= depth; ++d) {
    json row = Ranking(all, ScoreAfter(d));
    row["depth"] = d;
    row["pictures"] = PictureErrors(all, d);
    summary["by_depth"].push_back(row);
  }
  return summary;
}

std::string PlanTable(const json& summary) {
  std::string text = std::to_string(summary["plans"].get<int>()) + " plans of " +
                     std::to_string(summary["scenes"].get<int>()) + " scenes, " +
                     std::to_string(summary["scenes_with_spread"].get<int>()) +
                     " of which have better and worse plans\n";
  if (!summary.contains("ranking")) return text;
  char head[256];
  std::snprintf(head, sizeof head, "%-16s %-22s %-22s %8s %12s\n", "", "rank correlation",
                "ROC area (half)", "MAE", "MAE of copy");
  text += head;
  text += Line("whole plan", summary["ranking"], nullptr);
  text += Line("other runs", summary["ceiling"], nullptr);
  for (const json& row : summary["by_depth"])
    text += Line("after " + std::to_string(row["depth"].get<int>()), row, row["pictures"]);
  return text;
}

}  // namespace prospect::tools
