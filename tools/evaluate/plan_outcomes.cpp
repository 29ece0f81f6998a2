#include "tools/evaluate/plan_outcomes.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "base/disk_error.h"
#include "base/line_file.h"
#include "base/random.h"
#include "sim/rollout.h"
#include "tools/evaluate/decider.h"

namespace prospect::tools {
namespace {

using nlohmann::json;
using planner::Path;

constexpr std::uint64_t kChoiceStream = 0x63686f696365ULL;
constexpr std::uint64_t kRunStream = 0x706c616e73ULL;

void Grow(const planner::TaskRules& rules, const std::vector<bool>& present, Path* path,
          std::vector<Path>* plans) {
  if (rules.Complete({}, *path)) {
    plans->push_back(*path);
    return;
  }
  for (const int action : rules.AllowedActions({}, *path)) {
    if (!present.at(static_cast<std::size_t>(action))) continue;
    path->push_back(static_cast<std::uint8_t>(action));
    Grow(rules, present, path, plans);
    path->pop_back();
  }
}

// All plans under one noise seed. Plans stand sorted, so those with a common beginning stand
// together.
class Run {
 public:
  Run(sim::Task& task, const std::vector<Path>& plans, std::vector<int>* successes)
      : task_(task), plans_(plans), successes_(successes) {}

  // Plans `first` to `last` - 1 begin with the same `depth` actions, which have been carried out.
  void Explore(std::size_t first, std::size_t last, std::size_t depth) {
    const std::unique_ptr<sim::TaskState> here = task_.Save();
    while (first < last) {
      const std::uint8_t action = plans_[first].at(depth);
      std::size_t next = first;
      while (next < last && plans_[next].at(depth) == action) ++next;
      const bool begun = sim::RunAction(task_, action, nullptr);
      if (begun) Account(first, next, depth + 1);
      task_.Restore(*here);
      first = next;
    }
  }

 private:
  void Account(std::size_t first, std::size_t last, std::size_t depth) {
    const sim::Outcome outcome = task_.progress().outcome;
    if (outcome == sim::Outcome::kRunning && depth < plans_[first].size())
      return Explore(first, last, depth);
    if (outcome != sim::Outcome::kSuccess) return;
    // A success before the plan's end counts: the trial is over.
    for (std::size_t i = first; i < last; ++i) ++(*successes_)[i];
  }

  sim::Task& task_;
  const std::vector<Path>& plans_;
  std::vector<int>* successes_;
};

json ToJson(const std::vector<PlanOutcome>& outcomes) {
  json plans = json::array();
  for (const PlanOutcome& o : outcomes) plans.push_back({o.plan, o.successes, o.again});
  return plans;
}

std::vector<PlanOutcome> FromJson(const json& plans) {
  std::vector<PlanOutcome> outcomes;
  for (const json& o : plans) {
    outcomes.push_back({o.at(0).get<Path>(), o.at(1).get<int>(), o.at(2).get<int>()});
  }
  return outcomes;
}

}  // namespace

std::vector<Path> LegalPlans(const sim::Task& task, std::uint64_t scene_seed, int most) {
  std::vector<Path> plans;
  Path path;
  Grow(RulesOf(task.spec()), task.PresentActions(), &path, &plans);
  if (static_cast<int>(plans.size()) <= most) return plans;
  std::mt19937_64 random(base::MixSeeds({scene_seed, kChoiceStream}));
  std::vector<Path> chosen;
  std::sample(plans.begin(), plans.end(), std::back_inserter(chosen), most, random);
  return chosen;
}

std::vector<PlanOutcome> CarryOut(sim::Task& task, std::uint64_t scene_seed,
                                  const std::vector<Path>& plans, int runs) {
  const std::unique_ptr<sim::TaskState> start = task.Save();
  std::vector<std::vector<int>> counts(2, std::vector<int>(plans.size(), 0));
  for (int i = 0; i < 2 * runs; ++i) {
    task.SetNoiseSeed(base::MixSeeds({scene_seed, kRunStream, static_cast<std::uint64_t>(i)}));
    Run(task, plans, &counts[i < runs ? 0 : 1]).Explore(0, plans.size(), 0);
    task.Restore(*start);
  }
  std::vector<PlanOutcome> outcomes;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    outcomes.push_back({plans[i], counts[0][i], counts[1][i]});
  }
  return outcomes;
}

OutcomeFile::OutcomeFile(const std::string& path) : path_(path) {
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::absolute(path).parent_path(), error);
  if (error) throw base::DiskError("cannot make the folder of " + path);
  std::ifstream file(path);
  std::string text;
  while (std::getline(file, text)) {
    try {
      const json line = json::parse(text);
      known_[line.at("seed")] = FromJson(line.at("plans"));
    } catch (const std::exception&) {
      continue;  // cut short by a killed writer: the scene is run again
    }
  }
}

const std::vector<PlanOutcome>* OutcomeFile::Find(std::uint64_t scene_seed) const {
  const auto found = known_.find(scene_seed);
  return found == known_.end() ? nullptr : &found->second;
}

void OutcomeFile::Store(std::uint64_t scene_seed, const std::vector<PlanOutcome>& outcomes) {
  base::AppendLine(path_, json{{"seed", scene_seed}, {"plans", ToJson(outcomes)}}.dump());
  known_[scene_seed] = outcomes;
}

std::string OutcomePath(const sim::TaskSpec& spec, const sim::TaskOptions& world, int runs,
                        int most) {
  const char* data = std::getenv("PROSPECT_DATA");
  const char* home = std::getenv("HOME");
  const std::string folder =
      data != nullptr && *data != '\0'
          ? std::string(data)
          : std::string(home != nullptr ? home : "/tmp") + "/.cache/prospect";
  return folder + "/plans/" + spec.name + "-" + spec.world_version + "-objects" +
         std::to_string(world.objects) + "-legs" + std::to_string(world.legs) +
         (world.tower > 2 ? "-tower" + std::to_string(world.tower) : "") + "-runs" +
         std::to_string(runs) + "-most" + std::to_string(most) + ".jsonl";
}

}  // namespace prospect::tools
