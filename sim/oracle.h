#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/task.h"

namespace prospect::sim {

// What can be achieved in a scene by someone who may try everything: the yardstick for planners.
// Every legal plan (without retries on the way, TaskSpec::IsRetry; from a trial's start and where a
// tower is built, only those in whose order one can stand, PlanRules) is run `rounds` times from
// the saved state, then the best one `best_runs` times with fresh noise.

enum class SceneClass {
  kSolvable,  // the best plan succeeded in at least 7 of 10 fresh runs
  kDoubtful,  // neither
  kHopeless,  // no success at all, in any run
};

const char* ToString(SceneClass scene_class);           // "solvable", "doubtful", "hopeless"
SceneClass SceneClassFromString(const std::string& s);  // throws std::invalid_argument

struct OracleOptions {
  int rounds = 3;
  int best_runs = 10;
  // Plans that begin anew from where the task is (their first action is a retry), instead of those
  // that go on. What was stacked before is not known then, so any order is tried.
  bool begin_anew = false;
};

// One complete legal plan and in how many rounds it succeeded.
struct PlanCount {
  std::vector<int> plan;
  int successes = 0;
};

struct OracleResult {
  SceneClass scene_class = SceneClass::kDoubtful;
  int rounds = 0;
  std::vector<PlanCount> plans;  // all complete ones of these, in lexicographic order
  std::vector<int> best_plan;    // most successes, the first of equals
  int best_runs = 0;
  int best_successes = 0;               // of best_runs, with fresh noise
  std::map<std::string, int> failures;  // reason -> (plan, round) pairs that failed for it

  double success_frequency() const;     // best_successes / best_runs
  double random_failure_share() const;  // share of all (plan, round) pairs that failed
};

// Consults the oracle from the task's current state, which is restored at the end. Plans with a
// common beginning share it: an action sequence is simulated once a round. `scene_seed` feeds the
// noise of the rounds and of the fresh runs, all different from the noise of the trial itself.
OracleResult ConsultOracle(Task& task, std::uint64_t scene_seed, const OracleOptions& options = {});

// The oracle for somebody who wants more than the task does. `all` is what ConsultOracle said of
// this scene, from the state in which the task is now; it is restored at the end. Of its plans only
// those that are `wanted` count; the best of them is run best_runs times, with the same noise as
// ConsultOracle's, and a run counts as a success only when `reached` says so of the task's last
// state, too. Hopeless where no plan is wanted. `failures` stays empty.
OracleResult NarrowOracle(Task& task, std::uint64_t scene_seed, const OracleResult& all,
                          const std::function<bool(const std::vector<int>&)>& wanted,
                          const std::function<bool(const Task&)>& reached,
                          const OracleOptions& options = {});

}  // namespace prospect::sim
