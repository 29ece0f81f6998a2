#include "planner/plan.h"

#include <cstdio>

namespace prospect::planner {
namespace {

std::string StepLine(int number, const PlanStep& step) {
  char line[160];
  std::snprintf(line, sizeof line, "%4d  %6d  %6.3f  %6.3f  %6.3f  %6.3f  %6.3f  %6lld\n", number,
                step.action, step.score, step.value, step.done, step.q, step.prior,
                static_cast<long long>(step.visits));
  return line;
}

}  // namespace

const char* ToString(Rejection rejection) {
  switch (rejection) {
    case Rejection::kNone:
      return "none";
    case Rejection::kNotPermitted:
      return "not permitted";
    case Rejection::kNotDone:
      return "action would not finish";
    case Rejection::kLowValue:
      return "value too low";
    case Rejection::kLowScore:
      return "score too low";
  }
  return "unknown";
}

const char* ToString(PlanStatus status) {
  switch (status) {
    case PlanStatus::kPlan:
      return "plan";
    case PlanStatus::kRefused:
      return "refused";
    case PlanStatus::kIncomplete:
      return "incomplete";
    case PlanStatus::kNoEvaluation:
      return "no evaluation";
  }
  return "unknown";
}

std::string ToString(const Plan& plan) {
  std::string text = std::string(ToString(plan.status));
  text += plan.reason.empty() ? "\n" : ": " + plan.reason + "\n";
  if (plan.best.steps.empty()) return text;
  text += "step  action   score       V       f       Q       p  visits\n";
  int number = 0;
  for (const PlanStep& step : plan.best.steps) text += StepLine(++number, step);
  return text;
}

}  // namespace prospect::planner
