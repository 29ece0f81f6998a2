#include "sim/oracle.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "base/random.h"
#include "sim/plan_rules.h"
#include "sim/rollout.h"

namespace prospect::sim {
namespace {

constexpr std::uint64_t kRoundStream =
    0x6f7261636c65ULL;  // keeps these runs apart from the trial's
constexpr std::uint64_t kBestStream = 0x62657374ULL;

// Tries every legal plan once under one noise seed, each beginning once.
class Round {
 public:
  // `rules`: where a tower is built, what may be tried; null: whatever is legal.
  Round(Task& task, bool begin_anew, const planner::TaskRules* rules,
        std::map<std::vector<int>, int>* successes, std::map<std::string, int>* failures)
      : task_(task),
        begin_anew_(begin_anew),
        rules_(rules),
        successes_(successes),
        failures_(failures) {}

  void Explore() {
    const std::unique_ptr<TaskState> here = task_.Save();
    for (int action : task_.LegalActions()) {
      if (task_.spec().IsRetry(Last(), action) != (begin_anew_ && plan_.empty())) continue;
      if (!Useful(action)) continue;
      plan_.push_back(action);
      RunAction(task_, action, nullptr);
      Account();
      plan_.pop_back();
      task_.Restore(*here);
    }
  }

 private:
  void Account() {
    const Progress progress = task_.progress();
    if (progress.outcome == Outcome::kSuccess) {
      ++(*successes_)[plan_];
    } else if (progress.outcome == Outcome::kFailure) {
      CountFailures(progress.reason, Remaining());
    } else {
      Explore();
    }
  }

  // Where plans begin anew the first of them follows what was carried out before.
  int Last() const {
    if (!plan_.empty()) return plan_.back();
    return begin_anew_ ? task_.progress().action : task_.spec().null_action();
  }

  // Whether a plan that goes on so can still end in one tower.
  bool Useful(int action) const {
    return rules_ == nullptr || rules_->Allowed({plan_.begin(), plan_.end()}, {}, action);
  }

  int Remaining() const { return task_.spec().plan_length - static_cast<int>(plan_.size()); }

  // A failed beginning fails every plan that begins so. What could follow is asked of the table and
  // the scene, because a failed task offers nothing any more.
  void CountFailures(const std::string& reason, int remaining) {
    if (remaining == 0) {
      (*successes_)[plan_] += 0;
      ++(*failures_)[reason];
      return;
    }
    const std::vector<bool> present = task_.PresentActions();
    for (int next : task_.spec().successors[plan_.back()]) {
      const bool repeated = std::find(plan_.begin(), plan_.end(), next) != plan_.end();
      if (!present[next] || (repeated && !task_.spec().repeats_allowed)) continue;
      if (task_.spec().IsRetry(Last(), next) || !Useful(next)) continue;
      plan_.push_back(next);
      CountFailures(reason, remaining - 1);
      plan_.pop_back();
    }
  }

  Task& task_;
  bool begin_anew_;
  const planner::TaskRules* rules_;
  std::map<std::vector<int>, int>* successes_;
  std::map<std::string, int>* failures_;
  std::vector<int> plan_;
};

SceneClass Classify(const OracleResult& result) {
  if (result.best_successes * 10 >= result.best_runs * 7) return SceneClass::kSolvable;
  const bool ever = std::any_of(result.plans.begin(), result.plans.end(),
                                [](const PlanCount& plan) { return plan.successes > 0; });
  return ever || result.best_successes > 0 ? SceneClass::kDoubtful : SceneClass::kHopeless;
}

using Reached = std::function<bool(const Task&)>;

bool Anyhow(const Task&) { return true; }

void RunBest(Task& task, const TaskState& start, std::uint64_t scene_seed, int runs,
             const Reached& reached, OracleResult* result) {
  result->best_runs = runs;
  for (int i = 0; i < runs; ++i) {
    task.SetNoiseSeed(base::MixSeeds({scene_seed, kBestStream, static_cast<std::uint64_t>(i)}));
    const RolloutResult run = RunPlan(task, result->best_plan, nullptr);
    result->best_successes += run.outcome == Outcome::kSuccess && reached(task);
    task.Restore(start);
  }
}

}  // namespace

const char* ToString(SceneClass scene_class) {
  switch (scene_class) {
    case SceneClass::kSolvable:
      return "solvable";
    case SceneClass::kDoubtful:
      return "doubtful";
    case SceneClass::kHopeless:
      return "hopeless";
  }
  return "unknown";
}

SceneClass SceneClassFromString(const std::string& s) {
  for (SceneClass c : {SceneClass::kSolvable, SceneClass::kDoubtful, SceneClass::kHopeless}) {
    if (s == ToString(c)) return c;
  }
  throw std::invalid_argument("'" + s + "' is no class of scenes: solvable, doubtful or hopeless");
}

double OracleResult::success_frequency() const {
  return best_runs > 0 ? static_cast<double>(best_successes) / best_runs : 0.0;
}

double OracleResult::random_failure_share() const {
  int successes = 0;
  for (const PlanCount& plan : plans) successes += plan.successes;
  const int runs = static_cast<int>(plans.size()) * rounds;
  return runs > 0 ? 1.0 - static_cast<double>(successes) / runs : 0.0;
}

OracleResult ConsultOracle(Task& task, std::uint64_t scene_seed, const OracleOptions& options) {
  if (options.rounds < 1 || options.best_runs < 1) {
    throw std::invalid_argument("the oracle needs at least one round and one run of the best plan");
  }
  const std::unique_ptr<TaskState> start = task.Save();
  OracleResult result;
  result.rounds = options.rounds;
  std::map<std::vector<int>, int> successes;
  planner::TaskRules rules = PlanRules(task.spec());
  const bool ordered = !rules.tower.empty() && !options.begin_anew && task.progress().segment < 0;
  if (ordered) rules.Prepare();
  for (int round = 0; round < options.rounds; ++round) {
    task.SetNoiseSeed(
        base::MixSeeds({scene_seed, kRoundStream, static_cast<std::uint64_t>(round)}));
    Round(task, options.begin_anew, ordered ? &rules : nullptr, &successes, &result.failures)
        .Explore();
    task.Restore(*start);
  }
  for (const auto& [plan, count] : successes) {
    if (result.best_plan.empty() || count > successes[result.best_plan]) result.best_plan = plan;
    result.plans.push_back({plan, count});
  }
  if (result.plans.empty()) {
    result.scene_class = SceneClass::kHopeless;
    return result;
  }
  RunBest(task, *start, scene_seed, options.best_runs, Anyhow, &result);
  result.scene_class = Classify(result);
  return result;
}

OracleResult NarrowOracle(Task& task, std::uint64_t scene_seed, const OracleResult& all,
                          const std::function<bool(const std::vector<int>&)>& wanted,
                          const Reached& reached, const OracleOptions& options) {
  OracleResult result;
  result.rounds = all.rounds;
  result.scene_class = SceneClass::kHopeless;
  std::copy_if(all.plans.begin(), all.plans.end(), std::back_inserter(result.plans),
               [&](const PlanCount& plan) { return wanted(plan.plan); });
  if (result.plans.empty()) return result;
  const auto fewer = [](const PlanCount& a, const PlanCount& b) {
    return a.successes < b.successes;
  };
  result.best_plan = std::max_element(result.plans.begin(), result.plans.end(), fewer)->plan;
  const std::unique_ptr<TaskState> start = task.Save();
  RunBest(task, *start, scene_seed, options.best_runs, reached, &result);
  result.scene_class = Classify(result);
  return result;
}

}  // namespace prospect::sim
