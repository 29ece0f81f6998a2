#include "agent/deliberation.h"

#include <algorithm>
#include <set>
#include <utility>

#include "agent/explanation.h"
#include "agent/illustration.h"
#include "agent/phase_clock.h"
#include "agent/refusal_reason.h"
#include "agent/what_if.h"
#include "base/hash.h"
#include "base/number_format.h"
#include "base/seconds_since.h"
#include "model/surprise.h"

namespace prospect::agent {
namespace {

using planner::NextStep;

// Enough for one of each first action to be among them.
constexpr int kListedFutures = 4096;

planner::Disbelief DisbeliefOf(const EpisodeOptions& options) {
  return {options.surprise, std::max(options.surprise, model::kAlarming)};
}

// `surprise`: of what is seen now.
std::string WhyAnew(const NextStep& next, double surprise) {
  if (next.surprise == 0) return "going on scored " + base::Fixed(next.going_on, kDigits);
  const std::string differs =
      next.surprise > surprise ? "an earlier picture differed" : "the picture differs";
  return "a patch of " + differs + " by " + base::Fixed(next.surprise, kDigits) +
         " from what was imagined";
}

SearchRecord RecordOf(const SearchAnswer& answer, const SearchQuestion& question,
                      const PlanContext& context) {
  SearchRecord record;
  record.act = answer.plan.ok();
  record.reason = RefusalReason(answer.plan, context);
  record.ended_by = answer.ended_by;
  record.score = answer.plan.best.score;
  record.threshold = question.parameters.refusal_threshold;
  record.root_value = answer.plan.root_value;
  record.rollouts = answer.rollouts;
  record.overshoot = std::max<std::int64_t>(0, answer.rollouts - question.parameters.samples);
  record.evaluations = answer.evaluations;
  record.requested = answer.requested;
  record.workers = answer.workers;
  record.converged = answer.converged;
  record.table = base::HexText(answer.table);
  record.seconds = answer.seconds;
  record.search_id = answer.search_id;
  record.epoch = answer.epoch;
  return record;
}

}  // namespace

Deliberation::Deliberation(Mind& mind, const TaskView& task, const EpisodeGoal& goal,
                           const EpisodeOptions& options, const Refusals& refusals,
                           planner::Path what_if, Listener& listener, EpisodeRecord* record)
    : mind_(mind),
      task_(task),
      options_(options),
      refusals_(refusals),
      listener_(listener),
      record_(record),
      what_if_(std::move(what_if)),
      goal_(goal.TermsFor(task)),
      rules_(goal.RulesFor(task)),
      attempts_(rules_, options.retries, DisbeliefOf(options)) {}

NextStep Deliberation::Decide(const Glimpse& first, const Glimpse& present, SearchRecord* search) {
  const PhaseClock::Moment since = PhaseClock::Now();
  std::vector<SearchRecord> records;
  const auto search_for = [&](const planner::Attempt& attempt) {
    planner::Plan plan;
    records.push_back(SearchOnce(attempt, first, present, &plan));
    return plan;
  };
  // What is seen, where that may matter for beginning anew.
  const double surprise =
      HeedsSurprises() ? course_.SurpriseAfter(attempts_.followed(), present.picture) : 0;
  NextStep next = attempts_.Next(search_for, surprise);
  const bool anew = next.kind == NextStep::Kind::kAnew;
  *search = anew ? std::move(records.back()) : std::move(records.front());
  search->surprise = surprise;
  if (next.action >= 0 && attempts_.followed() == 0) SetCourse(search);
  if (anew) search->note = "begins anew: " + WhyAnew(next, surprise);
  if (next.kind == NextStep::Kind::kCarryOn) {
    search->note = "the plan is lost (" + search->reason + "): on to where it can begin anew";
    search->steps.clear();
  }
  const std::string objection = Objection(next, present);
  if (!objection.empty()) {
    search->act = false;
    search->reason = objection;
    next = {};
  } else if (!search->note.empty()) {
    listener_.Tell(search->note);
  }
  search->kind = next.kind;
  search->decision_seconds = base::SecondsSince(since);
  return next;
}

SearchQuestion Deliberation::QuestionFor(const planner::Attempt& attempt, const Glimpse& first,
                                         const Glimpse& present) const {
  SearchQuestion question;
  question.rules = planner::RulesFor(rules_, attempt);
  question.executed = attempt.executed;
  question.goal = goal_;
  question.first = first;
  question.present = present;
  planner::SearchParameters& parameters = question.parameters = options_.search;
  const int remaining = attempt.plan_length - static_cast<int>(attempt.executed.size());
  parameters.depth = parameters.depth > 0 ? std::min(parameters.depth, remaining) : remaining;
  parameters.refusal_threshold = refusals_.threshold();
  if (options_.illustrate) parameters.listed_futures = kListedFutures;
  return question;
}

SearchRecord Deliberation::SearchOnce(const planner::Attempt& attempt, const Glimpse& first,
                                      const Glimpse& present, planner::Plan* plan) {
  const SearchQuestion question = QuestionFor(attempt, first, present);
  PhaseClock searching(&record_->phase_seconds["search"]);
  SearchAnswer answer = mind_.Search(question);
  searching.Stop();
  const PlanContext context{question.rules, question.parameters, question.executed, task_.actions};
  SearchRecord search = RecordOf(answer, question, context);
  search.steps = StepsOf(answer.plan, task_);
  record_->rollouts += answer.rollouts;
  record_->evaluations += answer.evaluations;
  if (FirstOfAll() && options_.explain) Explain(answer, context);
  if (options_.illustrate) AddPictures(answer.plan, &search);
  listener_.Searched(search, answer.plan);
  *plan = std::move(answer.plan);
  return search;
}

void Deliberation::Explain(const SearchAnswer& answer, const PlanContext& context) {
  Explanation explanation = agent::Explain(answer.plan, context);
  NameScene(*record_, &explanation);
  explanation.ended_by = answer.ended_by;
  explanation.rollouts = answer.rollouts;
  explanation.evaluations = answer.evaluations;
  explanation.workers = answer.workers;
  explanation.seconds = answer.seconds;
  if (!what_if_.empty()) {
    explanation.what_if = JudgePlan(what_if_, mind_.Judge(AllowedBeginnings(what_if_, context)),
                                    answer.plan, context);
  }
  record_->explanation = std::move(explanation);
}

void Deliberation::AddPictures(const planner::Plan& plan, SearchRecord* search) {
  const PhaseClock painting(&record_->phase_seconds["pictures"]);
  const bool explained = FirstOfAll() && record_->explanation;
  std::set<planner::Path> wanted = StatesOf(plan);
  if (explained) wanted.merge(StatesShown(*record_->explanation));
  auto pictures = mind_.Imagine({wanted.begin(), wanted.end()});
  if (explained) SetPictures(pictures, &*record_->explanation);
  Illustrate(plan, task_, std::move(pictures), search);
}

// How the plan that is followed is to look after each of its actions.
void Deliberation::SetCourse(SearchRecord* search) {
  if (!options_.illustrate && HeedsSurprises())
    SetPictures(mind_.Imagine(StatesOf(search->steps)), &search->steps);
  std::vector<Course::Step> steps;
  for (const auto& step : search->steps) steps.push_back({step.name, step.imagined});
  course_.Set(std::move(steps));
}

// No surprise is greater than 1.
bool Deliberation::HeedsSurprises() const {
  return options_.surprise < 1 && attempts_.heeds_surprises();
}

// Why nothing may be done, whatever the search says. Empty: no reason.
std::string Deliberation::Objection(const NextStep& next, const Glimpse& present) {
  const bool acts = next.action >= 0;
  if (FirstOfAll() && options_.novelty > 0) {
    const std::string unknown = UnknownPicture(acts);
    if (!unknown.empty()) return unknown;
  }
  if (!acts) return "";
  const std::string refused = refusals_.Objection();
  if (!refused.empty() || !HeedsSurprises()) return refused;
  const std::string gap = course_.Gap(present.picture.width, present.picture.height);
  return gap.empty()
             ? ""
             : "no server drew what is to be seen after " + gap +
                   ", so nobody could tell a plan that goes wrong; --surprise 1 does without";
}

std::string Deliberation::UnknownPicture(bool acts) {
  Recognition answer = mind_.Familiar();
  if (answer.novelty) {
    record_->familiarity =
        Familiarity{*answer.novelty, options_.novelty, record_->first, std::move(answer.redrawn)};
    if (record_->familiarity->foreign()) return model::NoveltyRefusal(*answer.novelty);
  }
  if (!acts || answer.defect.empty()) return "";
  return "nobody could say whether the picture is like those the networks were trained on (" +
         answer.defect + "); --novelty 0 does without";
}

}  // namespace prospect::agent
