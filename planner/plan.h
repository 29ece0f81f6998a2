// The answer of a search: a sequence of actions with its figures, or a refusal with the reason.
// Plain data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/path.h"

namespace prospect::planner {

// One step of a plan, with what the models said of the state after it.
struct PlanStep {
  int action = 0;
  float value = 0;          // V after the step
  float done = 0;           // f of the step
  float prior = 0;          // p of the step, seen from the state before it
  float q = 0;              // Q of the step, seen from the state before it
  double score = 0;         // V here times f of all steps so far
  std::int64_t visits = 0;  // N over all writers; 0 where no search was made
};

// Why a future was given up.
enum class Rejection {
  kNone,
  kNotPermitted,  // p < p_min: the action cannot follow
  kNotDone,       // f < c_done: the action would not finish
  kLowValue,      // V < v_failed
  kLowScore,      // complete, but its score is below the refusal threshold
};
const char* ToString(Rejection rejection);

// A future, good or bad: a path from the root. For kNotPermitted the last action was not imagined:
// the last step has V, f and score of 0.
struct Future {
  Path path;
  std::vector<PlanStep> steps;  // as long as the path
  double score = 0;         // V at the last node times f along the path (a score: architecture.md)
  std::int64_t visits = 0;  // N of the last node
  bool complete = false;    // complete by the task's rules (not merely as deep as the search looks)
  Rejection rejection = Rejection::kNone;
};

enum class PlanStatus {
  kPlan,        // `best` may be carried out
  kRefused,     // every future tried fails; `reason` says why
  kIncomplete,  // no future was followed to its end (too few samples); `best` is the most advanced
                // one, if any
  kNoEvaluation,  // the scene itself was not evaluated
};
const char* ToString(PlanStatus status);

struct Plan {
  PlanStatus status = PlanStatus::kNoEvaluation;
  Future
      best;  // kPlan: the plan. kRefused: the best of the bad ones, if any was followed to its end
  std::vector<Future> runners_up;  // other complete futures that may be carried out, best first
  std::vector<Future> rejected;    // futures given up, those that came furthest first
  std::string reason;              // one sentence for a person; empty for kPlan
  float root_value = 0;            // V of the scene as it is

  // How many futures ended each way, listed above or not.
  std::int64_t complete_futures = 0;
  std::int64_t not_permitted = 0;
  std::int64_t not_done = 0;
  std::int64_t low_value = 0;
  std::int64_t low_score = 0;
  std::int64_t untried = 0;  // actions permitted but never imagined

  bool ok() const { return status == PlanStatus::kPlan; }
};

// A short table for a person: one line a step.
std::string ToString(const Plan& plan);

}  // namespace prospect::planner
