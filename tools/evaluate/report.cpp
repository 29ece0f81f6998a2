#include "tools/evaluate/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "tools/common/interval.h"

namespace prospect::tools {
namespace {

using nlohmann::json;
using Scenes = std::vector<const SceneRecord*>;

Scenes OfClass(const std::vector<SceneRecord>& scenes, const std::string& name) {
  Scenes chosen;
  for (const SceneRecord& scene : scenes) {
    if (!scene["solved_at_start"].get<bool>() && scene["class"] == name) chosen.push_back(&scene);
  }
  return chosen;
}

int CountEnding(const Scenes& scenes, const std::string& row, const std::string& ending) {
  return static_cast<int>(std::count_if(scenes.begin(), scenes.end(), [&](const SceneRecord* s) {
    return (*s)["rows"][row]["ending"] == ending;
  }));
}

void PutShare(json* out, const std::string& key, int count, int total) {
  const Share share = ShareOf(count, total);
  (*out)[key] = share.value;
  (*out)[key + "_count"] = count;
  (*out)[key + "_interval"] = {share.low, share.high};
}

double Mean(const Scenes& scenes, const std::function<double(const SceneRecord&)>& value) {
  double sum = 0;
  for (const SceneRecord* scene : scenes) sum += value(*scene);
  return scenes.empty() ? 0 : sum / static_cast<double>(scenes.size());
}

std::vector<double> PlanSeconds(const std::vector<SceneRecord>& scenes, const std::string& row) {
  std::vector<double> all;
  for (const SceneRecord& scene : scenes) {
    for (double s : scene["rows"][row]["seconds"]) all.push_back(s);
  }
  std::sort(all.begin(), all.end());
  return all;
}

double Quantile(const std::vector<double>& sorted, double q) {
  if (sorted.empty()) return 0;
  return sorted[std::min(sorted.size() - 1, static_cast<std::size_t>(q * sorted.size()))];
}

void PutCounts(json* out, const std::vector<SceneRecord>& scenes) {
  const auto excluded = std::count_if(scenes.begin(), scenes.end(), [](const SceneRecord& s) {
    return s["solved_at_start"].get<bool>();
  });
  (*out)["scenes"] = scenes.size() - static_cast<std::size_t>(excluded);
  (*out)["solved_at_start_excluded"] = excluded;
  for (const char* name : {"solvable", "hopeless", "doubtful"}) {
    (*out)[name] = OfClass(scenes, name).size();
  }
}

void PutPlanner(json* out, const Scenes& solvable, const Scenes& hopeless) {
  for (const char* ending : {"solved", "refused", "failed", "stopped"}) {
    PutShare(out, std::string(ending) + "_solvable", CountEnding(solvable, "planner", ending),
             static_cast<int>(solvable.size()));
    PutShare(out, std::string(ending) + "_hopeless", CountEnding(hopeless, "planner", ending),
             static_cast<int>(hopeless.size()));
  }
}

// By how much more often the planner solves than `row` does, scene by scene, with the normal 95 %
// interval of paired differences.
void PutDifference(json* out, const std::string& row, const Scenes& scenes) {
  double sum = 0, squares = 0;
  for (const SceneRecord* scene : scenes) {
    const auto solved = [&](const std::string& name) {
      return (*scene)["rows"][name]["ending"] == "solved" ? 1 : 0;
    };
    const double difference = solved("planner") - solved(row);
    sum += difference;
    squares += difference * difference;
  }
  const double n = std::max<double>(1, static_cast<double>(scenes.size()));
  const double mean = sum / n;
  const double half = 1.96 * std::sqrt(std::max(0.0, squares / n - mean * mean) / n);
  (*out)["planner_minus_" + row] = mean;
  (*out)["planner_minus_" + row + "_interval"] = {mean - half, mean + half};
}

// Of the episodes whose plan was lost on the way, those that the oracle could still finish, and of
// these the finished ones.
void PutLost(json* out, const std::vector<SceneRecord>& scenes) {
  int lost = 0, recoverable = 0, finished = 0;
  for (const SceneRecord& scene : scenes) {
    const json& planner = scene["rows"]["planner"];
    if (!planner.contains("lost")) continue;
    ++lost;
    if (planner["lost"]["anew"] != "solvable") continue;
    ++recoverable;
    finished += planner["ending"] == "solved";
  }
  (*out)["lost"] = lost;
  PutShare(out, "lost_finished", finished, recoverable);
  (*out)["lost_recoverable"] = recoverable;
}

// Of the planner's plans; evaluations of `counted` scenes.
void PutCost(json* out, const std::vector<SceneRecord>& scenes, const Scenes& counted) {
  const std::vector<double> seconds = PlanSeconds(scenes, "planner");
  (*out)["seconds_per_plan_p50"] = Quantile(seconds, 0.5);
  (*out)["seconds_per_plan_p95"] = Quantile(seconds, 0.95);
  (*out)["evaluations_per_episode"] =
      Mean(counted, [](const SceneRecord& s) { return s["rows"]["planner"]["evaluations"]; });
}

std::string ShareLine(const json& summary, const std::string& name, const std::string& key) {
  char line[200];
  std::snprintf(line, sizeof line, "  %-34s %5.1f %%   [%5.1f, %5.1f]   %d\n", name.c_str(),
                100 * summary[key].get<double>(), 100 * summary[key + "_interval"][0].get<double>(),
                100 * summary[key + "_interval"][1].get<double>(),
                summary[key + "_count"].get<int>());
  return line;
}

std::string DifferenceLine(const json& summary, const std::string& row) {
  const std::string key = "planner_minus_" + row;
  char line[200];
  std::snprintf(line, sizeof line, "  %-34s %+5.1f     [%+5.1f, %+5.1f]\n",
                "  planner less that, paired", 100 * summary[key].get<double>(),
                100 * summary[key + "_interval"][0].get<double>(),
                100 * summary[key + "_interval"][1].get<double>());
  return line;
}

constexpr char kShareHeading[] =
    "                                      share    95 % interval    scenes\n";

}  // namespace

json SummariseUnclassed(const std::vector<SceneRecord>& scenes,
                        const std::vector<std::string>& rows) {
  Scenes all;
  for (const SceneRecord& scene : scenes) all.push_back(&scene);
  const auto total = static_cast<int>(all.size());
  json out = {{"scenes", total}};
  for (const char* ending : {"solved", "refused", "failed", "stopped"})
    PutShare(&out, ending, CountEnding(all, "planner", ending), total);
  for (const std::string& row : rows) {
    if (row == "planner") continue;
    PutShare(&out, row + "_solved", CountEnding(all, row, "solved"), total);
    PutDifference(&out, row, all);
  }
  PutCost(&out, scenes, all);
  return out;
}

json Summarise(const std::vector<SceneRecord>& scenes, const std::vector<std::string>& rows) {
  const Scenes solvable = OfClass(scenes, "solvable");
  const Scenes hopeless = OfClass(scenes, "hopeless");
  json out;
  PutCounts(&out, scenes);
  PutPlanner(&out, solvable, hopeless);
  out["oracle_success"] = Mean(solvable, [](const SceneRecord& s) { return s["oracle_success"]; });
  const double oracle = out["oracle_success"];
  out["solved_over_oracle"] = oracle > 0 ? out["solved_solvable"].get<double>() / oracle : 0.0;
  for (const std::string& row : rows) {
    if (row == "planner") continue;
    PutShare(&out, row + "_solved_solvable", CountEnding(solvable, row, "solved"),
             static_cast<int>(solvable.size()));
    PutDifference(&out, row, solvable);
  }
  PutLost(&out, scenes);
  PutCost(&out, scenes, solvable);
  return out;
}

std::string Table(const json& summary, const std::vector<std::string>& rows) {
  std::string text;
  char line[200];
  const auto add = [&](const std::string& name, const std::string& key) {
    text += ShareLine(summary, name, key);
  };
  std::snprintf(line, sizeof line, "%d scenes: %d solvable, %d hopeless, %d doubtful\n",
                summary["scenes"].get<int>(), summary["solvable"].get<int>(),
                summary["hopeless"].get<int>(), summary["doubtful"].get<int>());
  text += line;
  text += kShareHeading;
  for (const char* ending : {"solved", "refused", "stopped", "failed"}) {
    add(std::string("planner, solvable: ") + ending, std::string(ending) + "_solvable");
  }
  for (const char* ending : {"refused", "stopped", "failed"}) {
    add(std::string("planner, hopeless: ") + ending, std::string(ending) + "_hopeless");
  }
  for (const std::string& row : rows) {
    if (row == "planner") continue;
    add(row + ", solvable: solved", row + "_solved_solvable");
    text += DifferenceLine(summary, row);
  }
  if (summary["lost"] > 0) {
    std::snprintf(line, sizeof line,
                  "  plans lost on the way: %d; the oracle could still finish %d, the planner "
                  "finished %d of these\n",
                  summary["lost"].get<int>(), summary["lost_recoverable"].get<int>(),
                  summary["lost_finished_count"].get<int>());
    text += line;
  }
  std::snprintf(
      line, sizeof line,
      "  oracle's own success, solvable     %5.1f %%\n"
      "  planner's solved over the oracle's %5.1f %%\n"
      "  seconds a plan: median %.3f, 95th percentile %.3f; %.0f evaluations an episode\n",
      100 * summary["oracle_success"].get<double>(),
      100 * summary["solved_over_oracle"].get<double>(),
      summary["seconds_per_plan_p50"].get<double>(), summary["seconds_per_plan_p95"].get<double>(),
      summary["evaluations_per_episode"].get<double>());
  return text + line;
}

std::string UnclassedTable(const json& summary, const std::vector<std::string>& rows) {
  std::string text = std::to_string(summary["scenes"].get<int>()) + " scenes\n" + kShareHeading;
  for (const char* ending : {"solved", "refused", "stopped", "failed"})
    text += ShareLine(summary, std::string("planner: ") + ending, ending);
  for (const std::string& row : rows) {
    if (row == "planner") continue;
    text += ShareLine(summary, row + ": solved", row + "_solved");
    text += DifferenceLine(summary, row);
  }
  char line[160];
  std::snprintf(
      line, sizeof line,
      "  seconds a plan: median %.3f, 95th percentile %.3f; %.0f evaluations an episode\n",
      summary["seconds_per_plan_p50"].get<double>(), summary["seconds_per_plan_p95"].get<double>(),
      summary["evaluations_per_episode"].get<double>());
  return text + line;
}

}  // namespace prospect::tools
