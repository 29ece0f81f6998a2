#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "agent/explanation.h"
#include "planner/evaluation.h"

namespace prospect::agent {

// What the model expects of a plan that a person named. Pure functions.

/// The actions in "align(green), grasp(green)". Throws std::invalid_argument that names what is
/// wrong and the names there are.
planner::Path NamedPlan(const std::string& text, const std::vector<std::string>& names);

/// Steps of `path` that the task's rules allow: the model can be asked no further.
std::size_t AllowedSteps(const planner::Path& path, const PlanContext& context);

/// Its beginnings, the empty one first, as far as the rules allow it.
std::vector<planner::Path> AllowedBeginnings(const planner::Path& path, const PlanContext& context);

/// What the model expects of `path`, beside what the search answered.
/// @param evaluations of AllowedBeginnings(path)
WhatIf JudgePlan(const planner::Path& path,
                 const std::map<planner::Path, planner::Evaluation>& evaluations,
                 const planner::Plan& plan, const PlanContext& context);

}  // namespace prospect::agent
