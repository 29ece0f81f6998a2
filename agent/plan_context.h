#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/path.h"
#include "planner/search_parameters.h"
#include "planner/task_rules.h"

namespace prospect::agent {

/// What plans are judged by, and the names of what they do. Plain data; the functions are pure.
struct PlanContext {
  planner::TaskRules rules;
  planner::SearchParameters parameters;
  planner::Path executed;          ///< before the root
  std::vector<std::string> names;  ///< of actions, by index
};

/// "lift(green)"; "action 99" where there is no such name.
std::string NameOf(int action, const PlanContext& context);
/// "step 4, lift(green)".
std::string StepText(std::size_t number, int action, const PlanContext& context);
std::vector<std::string> NamesOf(const std::vector<int>& actions, const PlanContext& context);
std::vector<std::string> NamesOf(const planner::Path& path, const PlanContext& context);

/// Leading steps that both have.
std::size_t SharedSteps(const planner::Path& a, const planner::Path& b);

/// Decimals of numbers for people, of p and of all others.
inline constexpr int kDigits = 2;
inline constexpr int kDigitsOfP = 3;

}  // namespace prospect::agent
