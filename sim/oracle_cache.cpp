#include "sim/oracle_cache.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "base/disk_error.h"
#include "base/line_file.h"
#include "planner/tower.h"
#include "sim/plan_rules.h"

namespace prospect::sim {
namespace {

using nlohmann::json;

std::string DefaultDirectory() {
  if (const char* data = std::getenv("PROSPECT_DATA"); data != nullptr && *data != '\0') {
    return std::string(data) + "/oracle";
  }
  const char* home = std::getenv("HOME");
  return std::string(home != nullptr && *home != '\0' ? home : "/tmp") + "/.cache/prospect/oracle";
}

// Plans as digits from '0' on, one of which is ':': tasks have far fewer than 64 actions that the
// oracle could exhaust.
char Digit(int value) { return static_cast<char>('0' + value); }

std::string Encode(const std::vector<int>& plan) {
  std::string text;
  for (int action : plan) text += Digit(action);
  return text;
}

std::vector<int> Decode(const std::string& text) {
  std::vector<int> plan;
  for (char c : text) plan.push_back(c - '0');
  return plan;
}

json ToJson(std::uint64_t seed, const OracleResult& result) {
  std::string plans;
  for (const PlanCount& plan : result.plans) {
    plans += (plans.empty() ? "" : " ") + Encode(plan.plan) + ":" + std::to_string(plan.successes);
  }
  return {{"seed", seed},
          {"class", ToString(result.scene_class)},
          {"rounds", result.rounds},
          {"plans", plans},
          {"best", Encode(result.best_plan)},
          {"best_runs", result.best_runs},
          {"best_successes", result.best_successes},
          {"failures", result.failures}};
}

OracleResult FromJson(const json& line) {
  OracleResult result;
  result.scene_class = SceneClassFromString(line.at("class"));
  result.rounds = line.at("rounds");
  result.best_plan = Decode(line.at("best"));
  result.best_runs = line.at("best_runs");
  result.best_successes = line.at("best_successes");
  result.failures = line.at("failures").get<std::map<std::string, int>>();
  std::istringstream plans(line.at("plans").get<std::string>());
  std::string entry;
  while (plans >> entry) {
    const std::size_t colon = entry.rfind(':');
    result.plans.push_back({Decode(entry.substr(0, colon)), std::stoi(entry.substr(colon + 1))});
  }
  return result;
}

}  // namespace

OracleKey OracleKeyOf(const Task& task, int objects) {
  const TaskSpec& spec = task.spec();
  planner::TaskRules rules = PlanRules(spec);
  if (!rules.tower.empty()) rules.Prepare();
  return {spec.name, spec.world_version,
          objects,   spec.plan_length,
          "",        planner::TowerLevels(rules) > 2};
}

OracleCache::OracleCache(const OracleKey& key, std::string directory, const std::string& bundled) {
  if (directory.empty()) directory = DefaultDirectory();
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    throw base::DiskError("cannot make " + directory + " for the oracle's cache (" +
                          error.message() + "): set PROSPECT_DATA to a folder you may write to");
  }
  const std::string name = "/" + key.task + "-" + key.world_version + "-objects" +
                           std::to_string(key.objects) + "-legs" + std::to_string(key.legs) +
                           (key.ordered ? "-ordered" : "") +
                           (key.goal.empty() ? "" : "-" + key.goal) + ".jsonl";
  path_ = directory + name;
  if (!bundled.empty()) Load(bundled + name);
  Load(path_);
}

void OracleCache::Load(const std::string& path) {
  std::ifstream file(path);
  std::string text;
  while (std::getline(file, text)) {
    try {
      const json line = json::parse(text);
      results_[line.at("seed")] = FromJson(line);
    } catch (const std::exception&) {
      continue;  // a line cut short by a killed writer: its scene is consulted again
    }
  }
}

std::optional<OracleResult> OracleCache::Find(std::uint64_t scene_seed) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = results_.find(scene_seed);
  if (found == results_.end()) return std::nullopt;
  return found->second;
}

void OracleCache::Store(std::uint64_t scene_seed, const OracleResult& result) {
  const std::lock_guard<std::mutex> lock(mutex_);
  base::AppendLine(path_, ToJson(scene_seed, result).dump());
  results_[scene_seed] = result;
}

OracleResult ConsultOracleCached(Task& task, std::uint64_t scene_seed, OracleCache& cache) {
  task.Reset(scene_seed);
  if (const std::optional<OracleResult> known = cache.Find(scene_seed)) return *known;
  const OracleResult result = ConsultOracle(task, scene_seed);
  cache.Store(scene_seed, result);
  return result;
}

}  // namespace prospect::sim
