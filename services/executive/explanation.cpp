#include "services/executive/explanation.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/number_format.h"
#include "planner/plan_reader.h"

namespace prospect::services {
namespace {

using base::Apart;
using base::DigitsApart;
using planner::Future;
using planner::Path;
using planner::Plan;
using planner::PlanStep;
using planner::Rejection;

constexpr int kDigits = 2;
constexpr int kDigitsOfP = 3;

std::string Fixed(double x, int digits = kDigits) { return base::Fixed(x, digits); }

std::string NameOf(int action, const PlanContext& context) {
  const auto index = static_cast<std::size_t>(action);
  return index < context.names.size() ? context.names[index] : "action " + std::to_string(action);
}

// "step 4, lift(green)"
std::string Step(std::size_t number, int action, const PlanContext& context) {
  return "step " + std::to_string(number) + ", " + NameOf(action, context);
}

std::string Listed(const std::vector<std::string>& items) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ", ") + item;
  return text;
}

template <class Actions>
std::vector<std::string> Names(const Actions& actions, const PlanContext& context) {
  std::vector<std::string> names;
  for (const int action : actions) names.push_back(NameOf(action, context));
  return names;
}

std::size_t SharedSteps(const Path& a, const Path& b) {
  const std::size_t most = std::min(a.size(), b.size());
  return static_cast<std::size_t>(
      std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(most), b.begin()).first -
      a.begin());
}

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
         Fixed(steps[at].value, digits) + " at " + Step(at + 1, steps[at].action, context);
}

// V is below the limit at the last step. Where it fell further before, that is said, too.
std::string WhyLowValue(const std::vector<PlanStep>& steps, double root_value,
                        const PlanContext& context) {
  const std::size_t last = steps.size() - 1;
  const double before = ValueBefore(steps, last, root_value), value = steps[last].value;
  const double limit = context.parameters.v_failed;
  const int digits = std::max(DigitsApart(before, value), DigitsApart(value, limit));
  const std::string given_up = "; below " + Fixed(limit, digits) + " a future is given up.";
  if (before <= value) {
    return "V is only " + Fixed(value, digits) + " at " +
           Step(last + 1, steps[last].action, context) + given_up;
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
  return "p forbids " + Step(number, action, context) + ": p is " +
         Apart(prior, limit, kDigitsOfP) + ", below " + Apart(limit, prior, kDigitsOfP) + ".";
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
  return Step(number, weakest->action, context) + " (f " + Fixed(weakest->done) + ")";
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

std::string WhyLess(const Future& future, const Future& best, const PlanContext& context) {
  const double score = future.score, best_score = best.score;
  if (score < best_score) {
    return "Scores less: " + Apart(score, best_score) + " against " + Apart(best_score, score) +
           "." + WhatDiffers(future, best, context);
  }
  const std::string same = "Scores the same, " + Fixed(score);
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
  return text + ": V at its end is " + Fixed(future.steps.back().value) + ", its f multiply to " +
         Fixed(DoneAlong(future.steps)) + ".";
}

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

// A future before it is shown.
struct Candidate {
  const Future* future;
  bool followed;         // to its end
  std::size_t imagined;  // steps
};

Candidate CandidateOf(const Future& future) {
  const bool followed =
      future.rejection == Rejection::kNone || future.rejection == Rejection::kLowScore;
  const std::size_t missing = future.rejection == Rejection::kNotPermitted ? 1 : 0;
  return {&future, followed, future.path.size() - missing};
}

// Best first: those that came to their end, by score; then those that came furthest, and of those
// the ones whose last step was imagined.
bool Stronger(const Candidate& a, const Candidate& b) {
  if (a.followed != b.followed) return a.followed;
  const auto rank = [](const Candidate& c) {
    const Future& f = *c.future;
    const bool whole = f.path.size() == c.imagined;
    return std::make_tuple(c.followed ? 0 : c.imagined, whole, f.score, f.visits);
  };
  if (rank(a) != rank(b)) return rank(a) > rank(b);
  return a.future->path < b.future->path;
}

bool NeverImagined(const Candidate& candidate) { return candidate.imagined == 0; }

std::vector<Candidate> Candidates(const Plan& plan) {
  std::vector<Candidate> all;
  for (const auto* list : {&plan.runners_up, &plan.rejected}) {
    for (const Future& future : *list) {
      if (!future.path.empty() && future.path != plan.best.path) all.push_back(CandidateOf(future));
    }
  }
  std::sort(all.begin(), all.end(), Stronger);
  return all;
}

// "closest: step 2, grasp(red): f 0.04, below 0.10"; of a plan that came to its end all its
// actions.
std::string NearestMiss(const Future& future, const PlanContext& context) {
  const std::string where = future.rejection == Rejection::kLowScore
                                ? Listed(Names(future.path, context))
                                : Step(future.steps.size(), future.steps.back().action, context);
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

// The actions up to the one in which a future parts from the chosen plan.
Path Departure(const Path& path, const Path& chosen) {
  const std::size_t length = std::min(path.size(), SharedSteps(path, chosen) + 1);
  return Path(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(length));
}

// The best of all, the best of every other first action, then the best of every other way to part
// from the chosen plan, then whatever is best.
std::vector<const Future*> Alternatives(const Plan& plan) {
  std::vector<Candidate> lists[4];
  std::set<Path> departures;
  for (const Candidate& candidate : Candidates(plan)) {
    if (NeverImagined(candidate)) continue;
    const Path departure = Departure(candidate.future->path, plan.best.path);
    const bool first = departures.empty();
    const bool fresh = departures.insert(departure).second;
    const bool other_beginning = departure.size() == 1;
    lists[first ? 0 : !fresh ? 3 : other_beginning ? 1 : 2].push_back(candidate);
  }
  std::vector<Candidate> chosen;
  for (const auto& list : lists) chosen.insert(chosen.end(), list.begin(), list.end());
  if (chosen.size() > kAlternatives) chosen.resize(kAlternatives);
  std::sort(chosen.begin(), chosen.end(), Stronger);
  std::vector<const Future*> futures;
  for (const Candidate& candidate : chosen) futures.push_back(candidate.future);
  return futures;
}

ExplainedStep StepOf(const PlanStep& step, bool imagined, const PlanContext& context) {
  ExplainedStep shown;
  shown.action = step.action;
  shown.name = NameOf(step.action, context);
  shown.imagined = imagined;
  shown.value = step.value;
  shown.done = step.done;
  shown.prior = step.prior;
  shown.score = step.score;
  return shown;
}

ExplainedPlan PlanOf(const Future& future, const Plan& plan, const PlanContext& context) {
  const Candidate candidate = CandidateOf(future);
  ExplainedPlan shown;
  for (std::size_t i = 0; i < future.steps.size(); ++i)
    shown.steps.push_back(StepOf(future.steps[i], i < candidate.imagined, context));
  shown.score = future.score;
  shown.visits = future.visits;
  shown.to_its_end = candidate.followed;
  shown.shared = static_cast<int>(SharedSteps(future.path, plan.best.path));
  if (!candidate.followed) shown.given_up = static_cast<int>(future.path.size());
  shown.why = WhyLost(future, plan, context);
  return shown;
}

// Of a plan that may be carried out nothing is wrong; of the best of bad ones, what it lost by.
ExplainedPlan ChosenOf(const Plan& plan, const PlanContext& context) {
  ExplainedPlan shown = PlanOf(plan.best, plan, context);
  shown.shared = 0;
  shown.why.clear();
  if (plan.best.path.empty() || plan.ok()) return shown;
  if (plan.status == planner::PlanStatus::kIncomplete) {
    shown.to_its_end = false;
    shown.why = "Not followed to its end: the search came no further.";
  } else {
    shown.why = WhyLost(plan.best, plan, context);
  }
  return shown;
}

void NameTheRest(const Plan& plan, const PlanContext& context, Explanation* explanation) {
  std::set<int> heard;
  if (!plan.best.path.empty()) heard.insert(plan.best.path.front());
  for (const Candidate& candidate : Candidates(plan)) {
    heard.insert(candidate.future->path.front());
    if (!NeverImagined(candidate)) continue;
    const PlanStep& step = candidate.future->steps.back();
    explanation->ruled_out.push_back(NameOf(step.action, context) + " (p " +
                                     Fixed(step.prior, kDigitsOfP) + ")");
  }
  for (const int action : context.rules.AllowedActions(context.executed, {})) {
    if (heard.count(action) == 0) explanation->untried.push_back(NameOf(action, context));
  }
}

// With a capital and a full stop.
std::string Sentence(std::string text) {
  if (text.empty()) return text;
  if (text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text.back() == '.' ? text : text + ".";
}

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
  std::string text = forbidden + Step(index + 1, path[index], context) + ": ";
  if (context.rules.Complete(context.executed, before)) {
    return text + "the plan is complete before it.";
  }
  const auto taken = [&](const Path& list) {
    return std::find(list.begin(), list.end(), path[index]) != list.end();
  };
  if (!context.rules.repeats_allowed && (taken(before) || taken(context.executed)))
    text += "it was taken before; ";
  const auto allowed = Names(context.rules.AllowedActions(context.executed, before), context);
  return text + (allowed.empty() ? "nothing may follow there."
                                 : "allowed there: " + Listed(allowed) + ".");
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
  return std::string(best) + " scores " + Fixed(plan.best.steps[length - 1].score) +
         " after as many steps.";
}

// A named plan without trouble against the answer.
std::string Standing(const Future& named, const Plan& plan, const PlanContext& context) {
  const double threshold = context.parameters.refusal_threshold;
  if (!named.complete) {
    return "It is the beginning of a plan: so far it scores " + Fixed(named.score) + ". " +
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
  return "It scores as much as the chosen plan, " + Fixed(named.score) + ".";
}

std::string StepLine(std::size_t number, const ExplainedStep& step) {
  char line[200];
  if (step.imagined) {
    std::snprintf(line, sizeof line, "%4zu  %-24s %7.3f %7.3f %7.3f %7.3f\n", number,
                  step.name.c_str(), step.score, step.value, step.done, step.prior);
  } else {
    char prior[16] = "-";
    if (step.prior >= 0) std::snprintf(prior, sizeof prior, "%.3f", step.prior);
    std::snprintf(line, sizeof line, "%4zu  %-24s %7s %7s %7s %7s\n", number, step.name.c_str(),
                  "-", "-", "-", prior);
  }
  return line;
}

std::string Table(const ExplainedPlan& plan) {
  std::string text = "Step  Action                     Score       V       f       p\n";
  for (std::size_t i = 0; i < plan.steps.size(); ++i) text += StepLine(i + 1, plan.steps[i]);
  return text;
}

std::string Chain(const ExplainedPlan& plan) {
  std::vector<std::string> names;
  for (const auto& step : plan.steps) names.push_back(step.name);
  return Listed(names);
}

std::string WhatIfText(const WhatIf& what_if) {
  std::string text = "\nWhat if: " + Chain(what_if.plan) + "\n" + Table(what_if.plan);
  for (const auto& finding : what_if.findings) text += "  " + finding + '\n';
  return text;
}

// Calls visit(path, step) for every step that has a picture.
template <class Shown, class Visit>
void EachPlan(Shown& explanation, const Visit& visit) {
  visit(explanation.chosen);
  for (auto& plan : explanation.alternatives) visit(plan);
  if (explanation.what_if) visit(explanation.what_if->plan);
}

template <class Shown, class Visit>
void EachImagined(Shown& explanation, const Visit& visit) {
  EachPlan(explanation, [&](auto& plan) {
    Path path;
    for (auto& step : plan.steps) {
      path.push_back(static_cast<std::uint8_t>(step.action));
      if (step.imagined) visit(path, step);
    }
  });
}

}  // namespace

std::string SceneWords(std::int64_t seed) {
  return seed < 0 ? "the scene as it stood" : "scene " + std::to_string(seed);
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

Explanation Explain(const Plan& plan, const PlanContext& context) {
  Explanation explanation;
  explanation.act = plan.ok();
  explanation.reason = RefusalReason(plan, context);
  explanation.score = plan.best.score;
  explanation.root_value = plan.root_value;
  explanation.plan_length = context.rules.plan_length - static_cast<int>(context.executed.size());
  explanation.parameters = context.parameters;
  explanation.chosen = ChosenOf(plan, context);
  for (const Future* future : Alternatives(plan))
    explanation.alternatives.push_back(PlanOf(*future, plan, context));
  NameTheRest(plan, context, &explanation);
  return explanation;
}

planner::Path NamedPlan(const std::string& text, const std::vector<std::string>& names) {
  Path path;
  const std::string known = "; actions: " + Listed(names);
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
        Fixed(named.score) + ".");
  }
  what_if.plan.why = what_if.findings.front();
  return what_if;
}

std::set<Path> StatesShown(const Explanation& explanation) {
  std::set<Path> states;
  EachImagined(explanation, [&](const Path& path, const auto&) { states.insert(path); });
  return states;
}

void SetPictures(const std::map<Path, Picture>& pictures, Explanation* explanation) {
  EachImagined(*explanation, [&](const Path& path, ExplainedStep& step) {
    const auto found = pictures.find(path);
    if (found != pictures.end()) step.picture = found->second;
  });
}

std::string Headline(const Explanation& explanation) {
  if (!explanation.act) return "Refuse";
  return "Act: begin with " + explanation.chosen.steps.front().name;
}

std::string ScoreSentence(const Explanation& explanation) {
  const double score = explanation.score, threshold = explanation.parameters.refusal_threshold;
  if (!explanation.act) return Sentence(explanation.reason);
  const std::string compared = threshold > 0
                                   ? "; plans below " + Apart(threshold, score) + " are refused"
                                   : "; no threshold is set, so no plan is refused for its score";
  return "Score " + Apart(score, threshold) + compared + ".";
}

std::string ExplanationText(const Explanation& explanation, int most) {
  std::string text = Headline(explanation) + ". " + ScoreSentence(explanation) + '\n';
  if (!explanation.not_covered.empty()) text += explanation.not_covered + '\n';
  for (const auto& sentence : ConfidenceSentences(explanation.confidence, explanation.terms))
    text += sentence + '\n';
  if (explanation.terms) text += explanation.terms->table;
  if (!explanation.chosen.steps.empty()) {
    text += explanation.act ? "" : "The best that was imagined:\n";
    text += Table(explanation.chosen);
  }
  if (!explanation.chosen.why.empty()) text += "  " + explanation.chosen.why + '\n';
  int shown = 0;
  for (const auto& other : explanation.alternatives) {
    if (shown++ == most) break;
    text += (shown == 1 ? "\nAlternatives:\n" : "") + std::string("- ") + Chain(other) + "\n  " +
            other.why + '\n';
  }
  if (explanation.what_if) text += WhatIfText(*explanation.what_if);
  if (explanation.familiarity && !explanation.familiarity->foreign())
    text += '\n' + FamiliaritySentence(*explanation.familiarity) + '\n';
  return text;
}

}  // namespace prospect::services
