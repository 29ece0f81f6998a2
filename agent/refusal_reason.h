#pragma once

#include <string>

#include "agent/plan_context.h"
#include "planner/plan.h"

namespace prospect::agent {

/// Why no plan is carried out, the nearest miss first: "every future fails; closest: step 2,
/// grasp(red): f 0.04, below 0.10; in all: 2 with an action that would not finish (f < 0.100)". Of
/// futures that came to their end it is the one that scores best; of others the one that came
/// furthest and there lies nearest to its bound. The planner's own reason where nothing was missed
/// by a bound. Empty for a plan that may be carried out. A pure function.
std::string RefusalReason(const planner::Plan& plan, const PlanContext& context);

}  // namespace prospect::agent
