// Ways of finding a plan that need no search: the yardsticks that a search is measured against.
#pragma once

#include <cstdint>

#include "planner/model_source.h"
#include "planner/plan.h"
#include "planner/search_parameters.h"
#include "planner/task_rules.h"

namespace prospect::planner {

struct ExhaustiveResult {
  Plan plan;
  std::int64_t evaluations = 0;
};

// Expands every future the task allows and reads off the best by the same rules as a search. With
// `prune`, futures are not followed beyond p < p_min, f < c_done or V < v_failed (such a future
// cannot become the plan, so the plan is the same, for fewer evaluations). `batch`: paths asked for
// at once, >= 1.
ExhaustiveResult ExhaustivePlan(const TaskRules& rules, const SearchParameters& parameters,
                                const Path& executed, ModelSource* model, bool prune = true,
                                int batch = 64);

// Takes the highest Q among the allowed actions with p >= p_min (ties: lower index) until the plan
// is complete or `depth` long. Never refuses; a path that ends early means that nothing was
// permitted any more.
Path GreedyPlan(const TaskRules& rules, const SearchParameters& parameters, const Path& executed,
                ModelSource* model);

// Uniform over the allowed actions at each step; the same path for the same seed everywhere.
Path RandomPlan(const TaskRules& rules, const Path& executed, std::uint64_t seed);

// The plan of whoever judges nothing: it may be carried out. Refused for `reason` where it is
// empty.
Plan PlanOf(const Path& path, const char* reason);

}  // namespace prospect::planner
