#include "agent/refusal_reason.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/number_format.h"
#include "base/text.h"
#include "planner/plan_reader.h"

namespace prospect::agent {
namespace {

using base::Apart;
using planner::Future;
using planner::Plan;
using planner::PlanStep;
using planner::Rejection;

// The number by which a future was given up, and what it lies below.
struct Miss {
  const char* name;
  double value, limit;
};

Miss MissOf(const Future& future, const PlanContext& context) {
  const auto& limits = context.parameters;
  const PlanStep last = future.steps.empty() ? PlanStep{} : future.steps.back();
  switch (future.rejection) {
    case Rejection::kNotPermitted:
      return {"p", last.prior, limits.p_min};
    case Rejection::kNotDone:
      return {"f", last.done, limits.c_done};
    case Rejection::kLowValue:
      return {"V", last.value, limits.v_failed};
    case Rejection::kLowScore:
    case Rejection::kNone:
      break;
  }
  return {"score", future.score, limits.refusal_threshold};
}

// "closest: step 2, grasp(red): f 0.04, below 0.10"; of a plan that came to its end all its
// actions.
std::string NearestMiss(const Future& future, const PlanContext& context) {
  const std::string where =
      future.rejection == Rejection::kLowScore
          ? base::Joined(NamesOf(future.path, context))
          : StepText(future.steps.size(), future.steps.back().action, context);
  const Miss miss = MissOf(future, context);
  const int digits = miss.limit < 0.1 ? kDigitsOfP : kDigits;
  return "closest: " + where + ": " + miss.name + " " + Apart(miss.value, miss.limit, digits) +
         ", below " + Apart(miss.limit, miss.value, digits);
}

// The one that came furthest; of those, the one that lies nearest below its bound.
const Future* Nearest(const std::vector<Future>& futures, const PlanContext& context) {
  const auto rank = [&](const Future& future) {
    const Miss miss = MissOf(future, context);
    return std::make_pair(future.steps.size(), miss.limit > 0 ? miss.value / miss.limit : 0);
  };
  const auto nearest =
      std::max_element(futures.begin(), futures.end(),
                       [&](const Future& a, const Future& b) { return rank(a) < rank(b); });
  return nearest == futures.end() || nearest->steps.empty() ? nullptr : &*nearest;
}

}  // namespace

std::string RefusalReason(const Plan& plan, const PlanContext& context) {
  if (plan.ok()) return "";
  const std::string tally = planner::Tally(plan, context.parameters);
  if (plan.best.rejection == Rejection::kLowScore) {
    return "no plan scores enough; " + NearestMiss(plan.best, context) + "; plans followed to " +
           "their end: " + std::to_string(plan.complete_futures) +
           (tally.empty() ? "" : "; others: " + tally);
  }
  const Future* nearest = Nearest(plan.rejected, context);
  if (plan.status != planner::PlanStatus::kRefused || nearest == nullptr) return plan.reason;
  return "every future fails; " + NearestMiss(*nearest, context) + "; in all: " + tally;
}

}  // namespace prospect::agent
