#pragma once

#include <string>
#include <vector>

#include "agent/plan_context.h"
#include "planner/plan.h"

namespace prospect::agent {

// Why a future was not chosen, in sentences for people. Numbers that are compared are given with
// enough digits to differ. Pure functions.

/// By what it lost: where and how far V fell, which f is too low, what p forbids, by how much it
/// scores less. A sentence or two.
std::string WhyLost(const planner::Future& future, const planner::Plan& plan,
                    const PlanContext& context);

/// Why not, in a few words.
std::string WhyNot(const planner::Future& future, double chosen_score);

// The parts, each for one way to lose.

/// V is below the limit at the last step. Where it fell further before, that is said, too.
std::string WhyLowValue(const std::vector<planner::PlanStep>& steps, double root_value,
                        const PlanContext& context);
std::string WhyNotDone(double done, std::size_t number, int action, const PlanContext& context);
std::string WhyNotPermitted(double prior, std::size_t number, int action,
                            const PlanContext& context);
std::string WhyLowScore(const planner::Future& future, const PlanContext& context);
std::string WhyLess(const planner::Future& future, const planner::Future& best,
                    const PlanContext& context);

}  // namespace prospect::agent
