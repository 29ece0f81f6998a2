#include "agent/explanation.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "agent/refusal_reason.h"
#include "agent/why_lost.h"
#include "base/number_format.h"

namespace prospect::agent {
namespace {

using base::Fixed;
using planner::Future;
using planner::Path;
using planner::Plan;
using planner::PlanStep;
using planner::Rejection;

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
    if (!heard.contains(action)) explanation->untried.push_back(NameOf(action, context));
  }
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

}  // namespace prospect::agent
