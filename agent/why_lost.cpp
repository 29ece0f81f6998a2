#include "agent/why_lost.h"

#include <algorithm>

#include "base/number_format.h"

namespace prospect::agent {
namespace {

using base::Apart;
using base::DigitsApart;
using planner::Fixed;
using planner::Future;
using planner::Plan;
using planner::PlanStep;
using planner::Rejection;

double ValueBefore(const std::vector<PlanStep>& steps, std::size_t index, double root_value) {
  return index == 0 ? root_value : steps[index - 1].value;
}

double FallAt(const std::vector<PlanStep>& steps, std::size_t index, double root_value) {
  return ValueBefore(steps, index, root_value) - steps[index].value;
}

// The step at which V falls furthest; of equals the last.
std::size_t DeepestFall(const std::vector<PlanStep>& steps, double root_value) {
  std::size_t deepest = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    if (FallAt(steps, i, root_value) >= FallAt(steps, deepest, root_value)) deepest = i;
  }
  return deepest;
}

std::string Fall(const std::vector<PlanStep>& steps, std::size_t at, double root_value, int digits,
                 const PlanContext& context) {
  return "from " + Fixed(ValueBefore(steps, at, root_value), digits) + " to " +
         Fixed(steps[at].value, digits) + " at " + StepText(at + 1, steps[at].action, context);
}

double DoneAlong(const std::vector<PlanStep>& steps) {
  double product = 1;
  for (const auto& step : steps) product *= step.done;
  return product;
}

std::string WeakestStep(const std::vector<PlanStep>& steps, const PlanContext& context) {
  const auto weakest = std::min_element(
      steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a.done < b.done; });
  const auto number = static_cast<std::size_t>(weakest - steps.begin()) + 1;
  return StepText(number, weakest->action, context) + " (f " + Fixed(weakest->done, kDigits) + ")";
}

// The factor of the score that differs more.
std::string WhatDiffers(const Future& future, const Future& best, const PlanContext& context) {
  if (future.steps.empty() || best.steps.empty()) return "";
  const double value = future.steps.back().value, best_value = best.steps.back().value;
  const double done = DoneAlong(future.steps), best_done = DoneAlong(best.steps);
  if (value * best_done <= done * best_value) {
    return " V at its end is " + Apart(value, best_value) + ", the chosen plan's " +
           Apart(best_value, value) + ".";
  }
  return " Its f multiply to " + Apart(done, best_done) + ", the chosen plan's to " +
         Apart(best_done, done) + "; the weakest is " + WeakestStep(future.steps, context) + ".";
}

}  // namespace

std::string WhyLowValue(const std::vector<PlanStep>& steps, double root_value,
                        const PlanContext& context) {
  const std::size_t last = steps.size() - 1;
  const double before = ValueBefore(steps, last, root_value), value = steps[last].value;
  const double limit = context.parameters.v_failed;
  const int digits = std::max(DigitsApart(before, value), DigitsApart(value, limit));
  const std::string given_up = "; below " + Fixed(limit, digits) + " a future is given up.";
  if (before <= value) {
    return "V is only " + Fixed(value, digits) + " at " +
           StepText(last + 1, steps[last].action, context) + given_up;
  }
  std::string text = "V fell " + Fall(steps, last, root_value, digits, context) + given_up;
  const std::size_t deepest = DeepestFall(steps, root_value);
  if (deepest != last) {
    text += " Most was lost before: " + Fall(steps, deepest, root_value, kDigits, context) + ".";
  }
  return text;
}

std::string WhyNotDone(double done, std::size_t number, int action, const PlanContext& context) {
  const double limit = context.parameters.c_done;
  return "f of step " + std::to_string(number) + " is " + Apart(done, limit) + ", below " +
         Apart(limit, done) + ": the model expects " + NameOf(action, context) + " to fail.";
}

std::string WhyNotPermitted(double prior, std::size_t number, int action,
                            const PlanContext& context) {
  const double limit = context.parameters.p_min;
  return "p forbids " + StepText(number, action, context) + ": p is " +
         Apart(prior, limit, kDigitsOfP) + ", below " + Apart(limit, prior, kDigitsOfP) + ".";
}

std::string WhyLess(const Future& future, const Future& best, const PlanContext& context) {
  const double score = future.score, best_score = best.score;
  if (score < best_score) {
    return "Scores less: " + Apart(score, best_score) + " against " + Apart(best_score, score) +
           "." + WhatDiffers(future, best, context);
  }
  const std::string same = "Scores the same, " + Fixed(score, kDigits);
  if (future.visits < best.visits) {
    return same + "; the chosen plan was visited more often (" + std::to_string(best.visits) +
           " times against " + std::to_string(future.visits) + ").";
  }
  return same +
         ", and was visited as often: of equals, the plan whose actions stand first in the "
         "task's table is taken.";
}

std::string WhyLowScore(const Future& future, const PlanContext& context) {
  const double limit = context.parameters.refusal_threshold;
  std::string text = "Scores " + Apart(future.score, limit) + ", below the " +
                     Apart(limit, future.score) + " under which plans are refused";
  if (future.steps.empty()) return text + ".";
  return text + ": V at its end is " + Fixed(future.steps.back().value, kDigits) +
         ", its f multiply to " + Fixed(DoneAlong(future.steps), kDigits) + ".";
}

std::string WhyLost(const Future& future, const Plan& plan, const PlanContext& context) {
  if (future.steps.empty()) return "";
  const PlanStep& last = future.steps.back();
  switch (future.rejection) {
    case Rejection::kNotPermitted:
      return WhyNotPermitted(last.prior, future.steps.size(), last.action, context);
    case Rejection::kNotDone:
      return WhyNotDone(last.done, future.steps.size(), last.action, context);
    case Rejection::kLowValue:
      return WhyLowValue(future.steps, plan.root_value, context);
    case Rejection::kLowScore:
      return WhyLowScore(future, context);
    case Rejection::kNone:
      break;
  }
  return WhyLess(future, plan.best, context);
}

std::string WhyNot(const planner::Future& future, double chosen_score) {
  const planner::PlanStep last = future.steps.empty() ? planner::PlanStep{} : future.steps.back();
  switch (future.rejection) {
    case planner::Rejection::kNotPermitted:
      return "ruled out from the start (p " + planner::Fixed(last.prior, 3) + ")";
    case planner::Rejection::kNotDone:
      return "would not finish (f " + planner::Fixed(last.done, 2) + ")";
    case planner::Rejection::kLowValue:
      return "leads to failure (V " + planner::Fixed(last.value, 2) + ")";
    case planner::Rejection::kLowScore:
      return "too unlikely to succeed (score " + planner::Fixed(future.score, 2) + ")";
    case planner::Rejection::kNone:
      break;
  }
  return "less likely to succeed (score " + base::Apart(future.score, chosen_score) + " against " +
         base::Apart(chosen_score, future.score) + ")";
}

}  // namespace prospect::agent
