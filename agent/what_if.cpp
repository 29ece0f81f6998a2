#include "agent/what_if.h"

#include <algorithm>
#include <stdexcept>

#include "agent/why_lost.h"
#include "base/number_format.h"
#include "base/text.h"

namespace prospect::agent {
namespace {

using base::Apart;
using base::Fixed;
using planner::Future;
using planner::Path;
using planner::Plan;
using planner::PlanStep;

std::string Trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Parted at the commas outside brackets.
std::vector<std::string> Items(const std::string& text) {
  std::vector<std::string> items(1);
  int depth = 0;
  for (const char c : text) {
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (c == ',' && depth == 0) {
      items.emplace_back();
    } else {
      items.back() += c;
    }
  }
  for (auto& item : items) item = Trimmed(item);
  return items;
}

// Why the rules forbid the step at `index` of `path`, and what they allow in its place.
std::string WhyForbidden(const Path& path, std::size_t index, const PlanContext& context) {
  const Path before(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(index));
  const char* forbidden = context.rules.goal.empty() ? "The task's rules forbid "
                                                     : "The task's rules and the goal forbid ";
  std::string text = forbidden + StepText(index + 1, path[index], context) + ": ";
  if (context.rules.Complete(context.executed, before)) {
    return text + "the plan is complete before it.";
  }
  const auto taken = [&](const Path& list) {
    return std::find(list.begin(), list.end(), path[index]) != list.end();
  };
  if (!context.rules.repeats_allowed && (taken(before) || taken(context.executed)))
    text += "it was taken before; ";
  const auto allowed = NamesOf(context.rules.AllowedActions(context.executed, before), context);
  return text + (allowed.empty() ? "nothing may follow there."
                                 : "allowed there: " + base::Joined(allowed) + ".");
}

// What the search gives futures up for, in the order in which it looks at them.
std::string Trouble(const std::vector<PlanStep>& steps, double root_value,
                    const PlanContext& context) {
  const auto& limits = context.parameters;
  const PlanStep& step = steps.back();
  if (step.prior < limits.p_min)
    return WhyNotPermitted(step.prior, steps.size(), step.action, context);
  if (step.done < limits.c_done) return WhyNotDone(step.done, steps.size(), step.action, context);
  if (step.value < limits.v_failed) return WhyLowValue(steps, root_value, context);
  return "";
}

// The first steps of a plan against as many of the chosen one's.
std::string BesideTheBeginning(const Future& named, const Plan& plan) {
  const std::size_t length = named.path.size();
  const char* best = plan.ok() ? "The chosen plan" : "The best that was imagined";
  if (plan.best.steps.size() < length) return "The search came to nothing as long.";
  if (SharedSteps(named.path, plan.best.path) == length)
    return std::string(best) + " begins with the same steps.";
  return std::string(best) + " scores " + Fixed(plan.best.steps[length - 1].score, kDigits) +
         " after as many steps.";
}

// A named plan without trouble against the answer.
std::string Standing(const Future& named, const Plan& plan, const PlanContext& context) {
  const double threshold = context.parameters.refusal_threshold;
  if (!named.complete) {
    return "It is the beginning of a plan: so far it scores " + Fixed(named.score, kDigits) + ". " +
           BesideTheBeginning(named, plan);
  }
  if (plan.ok() && named.path == plan.best.path) return "It is the chosen plan.";
  if (named.score < threshold) return WhyLowScore(named, context);
  if (!plan.ok()) {
    return "It scores " + Apart(named.score, threshold) + ", not below the " +
           Apart(threshold, named.score) +
           " under which plans are refused: the search did not come to it.";
  }
  if (named.score > plan.best.score) {
    return "It scores more than the chosen plan, " + Apart(named.score, plan.best.score) +
           " against " + Apart(plan.best.score, named.score) +
           ": the search did not come to it. More samples might.";
  }
  if (named.score < plan.best.score) return WhyLess(named, plan.best, context);
  return "It scores as much as the chosen plan, " + Fixed(named.score, kDigits) + ".";
}

}  // namespace

planner::Path NamedPlan(const std::string& text, const std::vector<std::string>& names) {
  Path path;
  const std::string known = "; actions: " + base::Joined(names);
  for (const std::string& item : Items(text)) {
    const auto found = std::find(names.begin(), names.end(), item);
    if (item.empty())
      throw std::invalid_argument("'" + text + "' is no plan: a name is missing" + known);
    if (found == names.end())
      throw std::invalid_argument("'" + item + "' is no action of this task" + known);
    path.push_back(static_cast<std::uint8_t>(found - names.begin()));
  }
  if (path.size() > planner::kMaxPathLength)
    throw std::invalid_argument("a plan has at most " + std::to_string(planner::kMaxPathLength) +
                                " actions");
  return path;
}

std::size_t AllowedSteps(const Path& path, const PlanContext& context) {
  Path before;
  for (const auto action : path) {
    if (!context.rules.Allowed(context.executed, before, action)) break;
    before.push_back(action);
  }
  return before.size();
}

std::vector<Path> AllowedBeginnings(const Path& path, const PlanContext& context) {
  std::vector<Path> beginnings;
  for (std::size_t length = 0; length <= AllowedSteps(path, context); ++length)
    beginnings.emplace_back(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(length));
  return beginnings;
}

WhatIf JudgePlan(const Path& path, const std::map<Path, planner::Evaluation>& evaluations,
                 const Plan& plan, const PlanContext& context) {
  WhatIf what_if;
  const std::size_t allowed = AllowedSteps(path, context);
  const double root_value = evaluations.at({}).value;
  Future named;
  named.complete = allowed == path.size() && context.rules.Complete(context.executed, path);
  double done = 1;
  for (std::size_t i = 0; i < allowed; ++i) {
    PlanStep step;
    step.action = path[i];
    step.prior = evaluations.at(named.path).p.at(path[i]);
    named.path.push_back(path[i]);
    const auto& after = evaluations.at(named.path);
    step.value = after.value;
    step.done = after.done;
    step.score = (done *= after.done) * after.value;
    named.steps.push_back(step);
    what_if.plan.steps.push_back(StepOf(step, true, context));
    const std::string trouble = Trouble(named.steps, root_value, context);
    if (trouble.empty()) continue;
    if (what_if.plan.given_up == 0) what_if.plan.given_up = static_cast<int>(i) + 1;
    what_if.findings.push_back(trouble);
  }
  named.score = named.steps.empty() ? 0 : named.steps.back().score;
  what_if.plan.score = allowed == path.size() ? named.score : 0;
  what_if.plan.to_its_end = named.complete && what_if.findings.empty();
  for (std::size_t i = allowed; i < path.size(); ++i) {
    PlanStep step;
    step.action = path[i];
    step.prior = -1;
    what_if.plan.steps.push_back(StepOf(step, false, context));
  }
  if (allowed < path.size()) {
    what_if.forbidden = static_cast<int>(allowed) + 1;
    what_if.findings.push_back(WhyForbidden(path, allowed, context));
  } else if (what_if.findings.empty()) {
    what_if.findings.push_back(Standing(named, plan, context));
  }
  if (named.complete && what_if.plan.given_up > 0) {
    what_if.findings.push_back(
        "The search would give it up there; followed to its end all the "
        "same, it scores " +
        Fixed(named.score, kDigits) + ".");
  }
  what_if.plan.why = what_if.findings.front();
  return what_if;
}

}  // namespace prospect::agent
