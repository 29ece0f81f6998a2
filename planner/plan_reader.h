// Reads the plan off a tree of evaluated paths. Pure functions: the same paths, evaluations and
// visits give the same plan, whatever the order in which they arrived; ties are broken by N, then
// by action index.
#pragma once

#include <string>

#include "planner/evaluation_table.h"
#include "planner/plan.h"
#include "planner/search_parameters.h"
#include "planner/shared_statistics.h"
#include "planner/task_rules.h"

namespace prospect::planner {

// What a plan is read from. All pointers must be set, but statistics.
struct PlanSource {
  const PathTree* paths = nullptr;
  const EvaluationTable* evaluations = nullptr;
  const SharedStatistics* statistics =
      nullptr;  // null: every evaluated path counts; else only those with N > 0
  const TaskRules* rules = nullptr;
  const SearchParameters* parameters = nullptr;
  Path executed;  // actions carried out before the root
};

// The complete future with the best score (V at its last node times f along the path), or a
// refusal. A future that is as long as parameters.depth counts as followed to its end. Futures with
// p < p_min, f < c_done or V < v_failed at any step are rejected; at the root neither f nor V is
// tested.
Plan ReadPlan(const PlanSource& source);

// How many futures were given up for what: "2 with an action that would not finish (f < 0.100), 1
// without hope (V < 0.020)". Empty where none was.
std::string Tally(const Plan& plan, const SearchParameters& parameters);

}  // namespace prospect::planner
