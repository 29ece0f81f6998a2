#include "services/executive/episode.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <stdexcept>

#include "base/hash.h"
#include "base/number_format.h"
#include "model/surprise.h"
#include "services/binding/search_messages.h"
#include "services/binding/task_messages.h"
#include "services/executive/covered.h"
#include "services/executive/policy.h"
#include "services/executive/preparation.h"

namespace prospect::services {
namespace {

using Clock = std::chrono::steady_clock;

search_image_t ImageMessage(const observation_t& observation) {
  search_image_t image{};
  // A picture is named by episode and frame: the same name is the same picture in every search of
  // the episode.
  image.image_id =
      ((observation.episode_id & 0x7fffffffffLL) << 24) | (observation.frame & 0xffffff);
  image.encoding = observation.encoding;
  image.width = observation.width;
  image.height = observation.height;
  image.data = observation.data;
  image.num_bytes = observation.num_bytes;
  return image;
}

std::string Number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// The world's short causes in words: "collision(barrel)", "time", "left_site".
std::string InWords(const std::string& cause) {
  const std::string collision = "collision(";
  if (cause.rfind(collision, 0) == 0)
    return "it ran into the " + cause.substr(collision.size(), cause.size() - collision.size() - 1);
  if (cause == "time") return "it ran out of time";
  if (cause == "left_site") return "it left the site";
  if (cause.rfind("obstacle(", 0) == 0) {
    return "its " + cause.substr(9, cause.size() - 10) + " touched the obstacle";
  }
  if (cause == "workspace(table)") return "it hit the table";
  if (cause.rfind("workspace", 0) == 0) return "it left its workspace";
  if (cause == "unreachable") return "it could not reach there";
  if (cause == "block_lost") return "a block fell off the table";
  if (cause == "plan_exhausted") return "no tower stood at the end of the plan";
  return cause;
}

std::string InWords(const ActRecord& act) {
  return act.name + " " + act.observed + (act.reason.empty() ? "" : ": " + InWords(act.reason));
}

StepRecord StepFrom(const planner::PlanStep& step, const std::string& name) {
  StepRecord record;
  record.action = step.action;
  record.name = name;
  record.score = step.score;
  record.value = step.value;
  record.done = step.done;
  record.visits = step.visits;
  record.predicted = step.done >= 0.5f;
  return record;
}

// `surprise`: of what is seen now.
std::string WhyAnew(const planner::NextStep& next, double surprise) {
  if (next.surprise == 0) return "going on scored " + base::Number("%.2f", next.going_on);
  const std::string differs =
      next.surprise > surprise ? "an earlier picture differed" : "the picture differs";
  return "a patch of " + differs + " by " + base::Number("%.2f", next.surprise) +
         " from what was imagined";
}

}  // namespace

std::string WhyNot(const planner::Future& future, double chosen_score) {
  const planner::PlanStep last = future.steps.empty() ? planner::PlanStep{} : future.steps.back();
  switch (future.rejection) {
    case planner::Rejection::kNotPermitted:
      return "ruled out from the start (p " + base::Number("%.3f", last.prior) + ")";
    case planner::Rejection::kNotDone:
      return "would not finish (f " + base::Number("%.2f", last.done) + ")";
    case planner::Rejection::kLowValue:
      return "leads to failure (V " + base::Number("%.2f", last.value) + ")";
    case planner::Rejection::kLowScore:
      return "too unlikely to succeed (score " + base::Number("%.2f", future.score) + ")";
    case planner::Rejection::kNone:
      break;
  }
  return "less likely to succeed (score " + base::Apart(future.score, chosen_score) + " against " +
         base::Apart(chosen_score, future.score) + ")";
}

Episode::Episode(Conversation& talk, const ExecutiveOptions& options, Tell tell)
    : talk_(talk),
      options_(options),
      tell_(std::move(tell)),
      goal_(options.goal),
      session_(talk),
      predictions_(talk),
      familiarity_(talk),
      actions_(talk) {
  record_.goal = goal_.Atoms();
  if (options_.reset) record_.seed = options_.seed;
  record_.policy = options_.policy;
}

EpisodeRecord Episode::Run() {
  Prepare();
  const std::string defect = goal_.Defect(*talk_.view().task(), talk_.view().label());
  if (!defect.empty()) {
    Verdict("refused", "the goal cannot be brought about: " + defect);
    ExplainUnsearched(record_.reason);
  } else if (!promised_.may_attempt) {
    AddTerms();
    Verdict("refused", promised_.words.back());
    ExplainUnsearched(record_.reason);
  } else if (options_.policy == "search") {
    RunSearchPolicy();
  } else if (options_.policy == "collect" || options_.policy == "expert") {
    talk_.Until([&] { return talk_.view().label().has_value(); }, 3000);
    if (!talk_.view().label())
      throw ExitError(kExitTimeout, "policy collect needs LABEL, and none was heard");
    const label_t& label = *talk_.view().label();
    const auto seed = static_cast<std::uint64_t>(label.seed >= 0 ? label.seed : options_.seed);
    RunFixedPlan(CollectPlan(*talk_.view().task(), label, seed, options_.policy == "collect"));
  } else {
    RunFixedPlan(ParsePlan(options_.policy));
  }
  Conclude();
  return std::move(record_);
}

EpisodeRecord Episode::Stopped(const std::string& reason) {
  Verdict("stopped", reason);
  Conclude();
  return std::move(record_);
}

void Episode::Prepare() {
  talk_.health().SetState(health_t::STATE_BUSY);
  auto since = Clock::now();
  AwaitServices(talk_, options_);
  RequireWorld(talk_, options_);
  talk_.HoldWorld();
  if (options_.reset || !options_.explain_only) talk_.ClaimRobot();
  AddSeconds("services", since);
  NameWhatIf();
  since = Clock::now();
  PrepareScene(talk_, options_);
  first_ = latest_ = Look(talk_, 0);
  talk_.HoldTask();
  AddSeconds("look", since);
  if (options_.policy == "search") model_ = ChooseModel(talk_, options_);
  if (options_.policy == "search") LearnWhatIsCovered();
  if (options_.policy == "search" && options_.promise.asked()) ChooseThreshold();

  const task_t& task = *talk_.view().task();
  record_.task = task.name;
  record_.world_version = task.world_version;
  record_.plan_length = task.plan_length;
  record_.first = PictureOf(first_);
  record_.frames_per_second = task.tick_seconds > 0 ? 1 / task.tick_seconds : 10;
  record_.engine = model_.engine;
  record_.weights = model_.server_id ? base::HexText(model_.weights_hash) : "";
  if (!talk_.view().label()) return;
  if (!options_.reset) record_.seed = talk_.view().label()->seed;
  const auto& present = talk_.view().label()->present;
  record_.objects = static_cast<int>(std::count(present.begin(), present.end(), 1));
}

// Said at the start: whether what is known of these weights holds for such scenes at all.
void Episode::LearnWhatIsCovered() {
  const model::CalibrationSample* sample = options_.promise.asked()
                                               ? &AwaitCalibration(talk_, model_)
                                               : talk_.view().calibration(model_.weights_hash);
  if (sample == nullptr) return;
  const auto& label = talk_.view().label();
  record_.not_covered =
      model::NotCovered(*sample, KindOf(*talk_.view().task(), label ? &*label : nullptr));
  if (record_.not_covered.empty()) return;
  spdlog::warn("{}", record_.not_covered);
  if (options_.promise.asked())
    throw ExitError(kExitWeights, "nothing can be promised: " + record_.not_covered);
}

// Null where none was heard, or where it says nothing of this kind of scenes.
const model::CalibrationSample* Episode::Calibration() const {
  return record_.not_covered.empty() ? talk_.view().calibration(model_.weights_hash) : nullptr;
}

// Below which plans are refused unless a person says otherwise.
double Episode::OwnThreshold() const {
  return record_.not_covered.empty() ? model_.refusal_threshold : 0;
}

// What was promised for, by what is known of these weights.
void Episode::ChooseThreshold() {
  promised_ = model::ThresholdFor(AwaitCalibration(talk_, model_), options_.promise);
  options_.refusal_threshold = promised_.value;
  for (const std::string& sentence : promised_.words) spdlog::info("{}", sentence);
}

SearchQuestion Episode::MakeQuestion(const planner::Attempt& attempt) const {
  const task_t& task = *talk_.view().task();
  SearchQuestion question;
  question.first = ImageMessage(first_);
  question.present = ImageMessage(latest_);
  question.budget_ms = options_.budget_ms;
  auto& root = question.root;
  root.weights_hash = model_.weights_hash;
  root.task_hash = task.task_hash;
  root.task = task.name;
  root.episode_id = talk_.view().episode_id();
  root.image0_id = question.first.image_id;
  root.image_id = question.present.image_id;
  root.executed = attempt.executed;
  root.num_executed = static_cast<std::int32_t>(root.executed.size());
  root.time_left = -1;
  root.goals = goal_.Atoms();
  root.num_goals = static_cast<std::int32_t>(root.goals.size());
  root.leaves = options_.leaves;

  planner::SearchParameters parameters = options_.search;
  const int remaining = attempt.plan_length - static_cast<int>(attempt.executed.size());
  parameters.depth = parameters.depth > 0 ? std::min(parameters.depth, remaining) : remaining;
  parameters.refusal_threshold =
      options_.refusal_threshold >= 0 ? options_.refusal_threshold : OwnThreshold();
  question.samples = parameters.samples;
  SetParameters(parameters, &root);
  if (attempt.plan_length != task.plan_length) SetPlanLength(attempt.plan_length, &root);
  return question;
}

// One for each first action that was not chosen: the best future through it, or the one that came
// furthest.
std::vector<planner::Future> Episode::OtherFirstActions(const planner::Plan& plan) const {
  std::vector<planner::Future> others;
  std::set<int> seen;
  if (plan.ok()) seen.insert(plan.best.path.front());
  for (const auto* list : {&plan.runners_up, &plan.rejected}) {
    for (const auto& future : *list) {
      if (!future.path.empty() && seen.insert(future.path.front()).second) others.push_back(future);
    }
  }
  return others;
}

void Episode::AddImagined(const planner::Plan& plan, SearchRecord* record) {
  const auto since = Clock::now();
  const auto others = OtherFirstActions(plan);
  const bool first = record_.searches.empty() && record_.explanation;
  std::set<planner::Path> wanted;
  if (first) wanted = StatesShown(*record_.explanation);
  for (std::size_t n = 1; n <= plan.best.path.size(); ++n) {
    wanted.emplace(plan.best.path.begin(), plan.best.path.begin() + static_cast<std::ptrdiff_t>(n));
  }
  // An action that p rules out was never imagined, so there is nothing to show.
  const auto imagined = [](const planner::Future& future) {
    return future.path.size() > 1 || future.rejection != planner::Rejection::kNotPermitted;
  };
  for (const auto& future : others) {
    if (imagined(future)) wanted.insert({future.path.front()});
  }
  auto pictures = predictions_.Fetch(session_.root(), {wanted.begin(), wanted.end()});
  if (first) SetPictures(pictures, &*record_.explanation);

  planner::Path prefix;
  for (const auto& step : plan.best.steps) {
    prefix.push_back(static_cast<std::uint8_t>(step.action));
    record->steps.push_back(StepFrom(step, ActionName(step.action)));
    record->steps.back().imagined = pictures[prefix];
  }
  for (const auto& future : others) {
    FutureRecord other;
    for (const auto action : future.path) other.names.push_back(ActionName(action));
    other.score = future.score;
    other.value = future.steps.back().value;
    other.done = future.steps.back().done;
    other.visits = future.visits;
    other.rejected = future.rejection != planner::Rejection::kNone;
    other.why = WhyNot(future, plan.best.score);
    other.imagined = pictures[{future.path.front()}];
    record->others.push_back(other);
  }
  AddSeconds("pictures", since);
}

bool Episode::ToBeExplained() const {
  return record_.searches.empty() && (options_.explain_only || !options_.out.empty());
}

// Before anything is searched, so that a wrong name costs no time.
void Episode::NameWhatIf() {
  if (options_.what_if.empty()) return;
  try {
    std::vector<std::string> names;
    for (const auto& action : talk_.view().task()->actions) names.push_back(action.name);
    what_if_ = NamedPlan(options_.what_if, names);
  } catch (const std::invalid_argument& error) {
    throw ExitError(kExitUsage, std::string("--what-if: ") + error.what());
  }
}

void Episode::NameScene(Explanation* explanation) const {
  explanation->task = record_.task;
  explanation->seed = record_.seed;
  explanation->weights = record_.weights;
  explanation->engine = record_.engine;
  explanation->goal = record_.goal;
  explanation->not_covered = record_.not_covered;
  explanation->seen = record_.first;
}

// Refused without a search.
void Episode::ExplainUnsearched(const std::string& reason) {
  if (!ToBeExplained()) return;
  Explanation explanation;
  explanation.reason = reason;
  explanation.terms = record_.terms;
  NameScene(&explanation);
  record_.explanation = std::move(explanation);
}

// By what plans of these weights are refused, where a calibration tells.
void Episode::AddTerms() {
  const model::CalibrationSample* sample = Calibration();
  if (sample == nullptr) return;
  const planner::SearchParameters& search = options_.search;
  const std::map<std::string, double> parameters = {
      {"samples", static_cast<double>(search.samples)},
      {"c", search.c},
      {"c_done", search.c_done},
      {"v_failed", search.v_failed},
      {"p_min", search.p_min},
      {"plan_length", talk_.view().task()->plan_length},
      {"retries", options_.retries}};
  record_.terms = TermsOf(*sample, search.rule, parameters, !record_.goal.empty());
  record_.terms->promises = promised_.words;
  if (!promised_.kept) record_.terms->table = model::CurveTable(*sample);
}

// Calibration scenes were judged by their first search, so only that one is compared with them; and
// of a plan that is not to be carried out nobody says how it would fare.
void Episode::AddConfidence(const SearchRecord& record) {
  const model::CalibrationSample* sample = Calibration();
  if (sample != nullptr && record.act)
    record_.confidence = ConfidenceOf(*sample, record.score, record.threshold);
}

// What the latest search judged by.
PlanContext Episode::Context() const {
  const planner::Search& search = session_.search();
  PlanContext context{search.rules(), search.parameters(), search.executed(), {}};
  for (const auto& action : talk_.view().task()->actions) context.names.push_back(action.name);
  return context;
}

void Episode::AddExplanation(const SearchAnswer& answer, const SearchRecord& record) {
  const PlanContext context = Context();
  Explanation explanation = Explain(answer.plan, context);
  NameScene(&explanation);
  explanation.ended_by = record.ended_by;
  explanation.rollouts = record.rollouts;
  explanation.evaluations = record.evaluations;
  explanation.workers = record.workers;
  explanation.seconds = record.seconds;
  if (!what_if_.empty()) {
    std::vector<planner::Path> beginnings;
    for (std::size_t length = 0; length <= AllowedSteps(what_if_, context); ++length)
      beginnings.emplace_back(what_if_.begin(),
                              what_if_.begin() + static_cast<std::ptrdiff_t>(length));
    explanation.what_if = JudgePlan(what_if_, session_.Evaluate(beginnings), answer.plan, context);
  }
  record_.explanation = std::move(explanation);
}

// When the safeguards have been asked, too.
void Episode::FinishExplanation(const SearchRecord& record) {
  if (!record_.explanation) return;
  Explanation& explanation = *record_.explanation;
  explanation.act = record.act;
  explanation.reason = record.reason;
  explanation.terms = record_.terms;
  explanation.confidence = record_.confidence;
  explanation.familiarity = record_.familiarity;
  // No plan lost by what it was imagined to do.
  if (record_.familiarity && record_.familiarity->foreign()) explanation.chosen.why.clear();
}

SearchRecord Episode::SearchOnce(const planner::Attempt& attempt, planner::Plan* plan) {
  const auto since = Clock::now();
  const SearchQuestion question = MakeQuestion(attempt);
  const SearchAnswer answer = session_.Search(question);
  AddSeconds("search", since);

  SearchRecord record;
  record.act = answer.plan.ok();
  record.reason = RefusalReason(answer.plan, Context());
  record.ended_by = answer.ended_by;
  record.score = answer.plan.best.score;
  record.threshold = ParameterOr(question.root, "refusal_threshold", 0);
  record.root_value = answer.plan.root_value;
  record.rollouts = answer.rollouts;
  record.overshoot = std::max<std::int64_t>(0, answer.rollouts - question.samples);
  record.evaluations = answer.evaluations;
  record.requested = answer.requested;
  record.workers = answer.workers;
  record.converged = answer.converged;
  record.table = base::HexText(answer.table);
  record.seconds = answer.seconds;
  record.search_id = session_.root().search_id;
  record.epoch = session_.root().epoch;
  if (ToBeExplained()) AddExplanation(answer, record);
  AddImagined(answer.plan, &record);
  spdlog::info("search {}: {} rollouts, {} evaluations, {:.2f} s; {}", record_.searches.size() + 1,
               record.rollouts, record.evaluations, record.seconds,
               Summary(answer.plan, *talk_.view().task()));
  *plan = answer.plan;
  return record;
}

void Episode::BeginAttempts() {
  const task_t& task = *talk_.view().task();
  planner::TaskRules rules = RulesFromTask(task);
  goal_.Set(task, &rules);
  attempts_.emplace(
      std::move(rules), options_.retries,
      planner::Disbelief{options_.surprise, std::max(options_.surprise, model::kAlarming)});
}

// `record` tells of the search that decided; of two, the other is told in its note.
planner::NextStep Episode::Decide(SearchRecord* record) {
  std::vector<SearchRecord> records;
  const auto search = [&](const planner::Attempt& attempt) {
    planner::Plan plan;
    records.push_back(SearchOnce(attempt, &plan));
    return plan;
  };
  const double surprise = SurpriseNow();
  planner::NextStep next = attempts_->Next(search, surprise);
  const bool anew = next.kind == planner::NextStep::Kind::kAnew;
  *record = anew ? std::move(records.back()) : std::move(records.front());
  if (next.action >= 0 && attempts_->followed() == 0) SetCourse(*record);
  if (anew) record->note = "begins anew: " + WhyAnew(next, surprise);
  if (next.kind == planner::NextStep::Kind::kCarryOn) {
    record->note = "the plan is lost (" + record->reason + "): on to where it can begin anew";
    record->steps.clear();
  }
  const std::string objection = Objection(next);
  if (!objection.empty()) {
    record->act = false;
    record->reason = objection;
    next = {};
  } else if (!record->note.empty()) {
    tell_(record->note);
  }
  return next;
}

// Why nothing may be done, whatever the search says. Empty: no reason.
std::string Episode::Objection(const planner::NextStep& next) {
  if (record_.searches.empty() && options_.novelty > 0) {
    Recognition answer = familiarity_.Ask(session_.root(), record_.first, options_.novelty);
    record_.familiarity = std::move(answer.familiarity);
    if (record_.familiarity && record_.familiarity->foreign())
      return model::NoveltyRefusal(record_.familiarity->novelty);
    if (next.action >= 0 && !answer.defect.empty())
      return "nobody could say whether the picture is like those the networks were trained on (" +
             answer.defect + "); --novelty 0 does without";
  }
  if (next.action >= 0 && !record_.not_covered.empty() && options_.refusal_threshold < 0)
    return record_.not_covered +
           " --refusal-threshold X attempts plans that score X or more all the same";
  if (next.action < 0 || !HeedsSurprises()) return "";
  const std::string gap = course_.Gap(latest_.width, latest_.height);
  return gap.empty()
             ? ""
             : "no server drew what is to be seen after " + gap +
                   ", so nobody could tell a plan that goes wrong; --surprise 1 does without";
}

// How the plan that is followed is to look after each of its actions.
void Episode::SetCourse(const SearchRecord& record) {
  std::vector<Course::Step> steps;
  for (const auto& step : record.steps) steps.push_back({step.name, step.imagined});
  course_.Set(std::move(steps));
}

// No surprise is greater than 1.
bool Episode::HeedsSurprises() const {
  return options_.surprise < 1 && attempts_->heeds_surprises();
}

// Of what is seen, where that may matter for beginning anew; else 0.
double Episode::SurpriseNow() const {
  return HeedsSurprises() ? course_.SurpriseAfter(attempts_->followed(), PictureOf(latest_)) : 0;
}

void Episode::RunSearchPolicy() {
  BeginAttempts();
  for (;;) {
    SearchRecord search;
    const planner::NextStep next = Decide(&search);
    if (record_.searches.empty()) {
      AddTerms();
      AddConfidence(search);
      FinishExplanation(search);
    }
    record_.searches.push_back(search);
    PublishPlan(search);
    if (next.kind == planner::NextStep::Kind::kGiveUp) {
      return Verdict(record_.acts.empty() ? "refused" : "stopped", search.reason);
    }
    if (options_.explain_only) return Verdict("explained", "");
    if (!Act(next.action)) return;
  }
}

void Episode::RunFixedPlan(const std::vector<int>& plan) {
  given_steps_ = plan.size();
  for (const int action : plan) {
    if (!Act(action)) return;
  }
  Verdict("stopped", "the given plan ended before the task was complete");
}

// When nobody knows how far an action came, the record tells that it was begun.
action_status_t Episode::CarryOut(int action) {
  try {
    return actions_.CarryOut(action);
  } catch (const std::exception& error) {
    ActRecord act;
    act.action = action;
    act.name = ActionName(action);
    act.observed = StateName(action_status_t::STATE_UNKNOWN);
    act.reason = error.what();
    record_.acts.push_back(act);
    throw;
  }
}

// Returns whether the episode goes on.
bool Episode::Act(int action) {
  const auto since = Clock::now();
  const std::int64_t begun_us = latest_.sim_time_us;
  const action_status_t status = CarryOut(action);
  if (status.state == action_status_t::STATE_REFUSED) {
    Verdict(record_.acts.empty() ? "failed" : "stopped",
            ActionName(action) + " was refused: " + status.reason);
    return false;
  }
  latest_ = Look(talk_, status.frame);
  AddSeconds("act", since);

  ActRecord act;
  act.action = action;
  act.name = ActionName(action);
  act.observed = StateName(status.state);
  act.reason = status.reason;
  act.sim_seconds = static_cast<double>(latest_.sim_time_us - begun_us) * 1e-6;
  act.picture = PictureOf(latest_);
  record_.acts.push_back(act);
  if (attempts_) attempts_->CarriedOut(action);
  if (!record_.searches.empty()) PublishPlan(record_.searches.back());
  TellOf(act);

  if (status.state != action_status_t::STATE_SUCCEEDED) {
    Verdict(status.state == action_status_t::STATE_FAILED ? "failed" : "stopped", InWords(act));
    return false;
  }
  return GoesOn(status);
}

// After an action that succeeded. A robot that judges no outcome has solved its task when its plan
// is carried out; one that does is asked.
bool Episode::GoesOn(const action_status_t& status) {
  const bool complete =
      attempts_ ? attempts_->complete()
                : static_cast<int>(record_.acts.size()) >= talk_.view().task()->plan_length;
  if (status.outcome == label_t::OUTCOME_FAILURE) {
    Verdict("failed", InWords(status.reason));
  } else if (status.outcome == label_t::OUTCOME_SUCCESS ||
             (complete && status.outcome == label_t::OUTCOME_UNKNOWN)) {
    const bool reached = GoalReached();
    Verdict(reached ? "solved" : "failed", reached ? "" : "goal not reached");
  } else if (complete && options_.policy == "search") {
    Verdict("stopped", "the plan was carried out and the task is not complete");
  } else {
    return true;
  }
  return false;
}

// By all that was carried out, or by what was since the plan was begun anew: a plan may have been
// taken for lost that was not.
bool Episode::GoalReached() const {
  const task_t& task = *talk_.view().task();
  planner::Path all;
  for (const auto& act : record_.acts) all.push_back(static_cast<std::uint8_t>(act.action));
  return goal_.Reached(task, all) ||
         (attempts_ && goal_.Reached(task, attempts_->current().executed));
}

void Episode::PublishPlan(const SearchRecord& record) {
  plan_t plan{};
  plan.executive_id = talk_.id();
  plan.search_id = record.search_id;
  plan.epoch = record.epoch;
  plan.episode_id = talk_.view().episode_id();
  plan.decision = record.act ? plan_t::DECISION_ACT : plan_t::DECISION_REFUSE;
  plan.reason = record.reason;
  plan.score = record.score;
  plan.rollouts = record.rollouts;
  plan.evaluations = record.evaluations;
  // The search looked from the state after the actions before it: what was carried out since is
  // told as observed.
  plan.num_executed =
      static_cast<std::int32_t>(record_.acts.size() - (record_.searches.size() - 1));
  for (std::size_t i = 0; i < record.steps.size(); ++i) {
    const auto& step = record.steps[i];
    plan_step_t message{};
    message.action = step.action;
    message.name = step.name;
    message.score = step.score;
    message.value = step.value;
    message.done = step.done;
    message.visits = step.visits;
    message.predicted = step.predicted ? 1 : 0;
    const std::size_t act = record_.searches.size() - 1 + i;
    if (act < record_.acts.size()) {
      message.observed = record_.acts[act].observed == "succeeded"
                             ? action_status_t::STATE_SUCCEEDED
                             : action_status_t::STATE_FAILED;
    }
    plan.steps.push_back(message);
  }
  plan.num_steps = static_cast<std::int32_t>(plan.steps.size());
  talk_.Say(plan);
}

void Episode::Conclude() {
  for (const auto& [frame, picture] : talk_.view().frames()) record_.frames.push_back(picture);
  talk_.health().SetState(health_t::STATE_DRAINING, record_.outcome);
  talk_.health().PublishNow();
}

void Episode::Verdict(const std::string& outcome, const std::string& reason) {
  record_.outcome = outcome;
  record_.reason = reason;
}

// "3/9 grasp(green): succeeded"
void Episode::TellOf(const ActRecord& act) const {
  std::size_t steps = given_steps_;
  if (attempts_) {
    const planner::Attempt& attempt = attempts_->current();
    steps = record_.acts.size() + static_cast<std::size_t>(attempt.plan_length) -
            std::min(attempt.executed.size(), static_cast<std::size_t>(attempt.plan_length));
  }
  tell_(std::to_string(record_.acts.size()) + "/" + std::to_string(steps) + " " + act.name + ": " +
        act.observed + (act.reason.empty() ? "" : ", " + InWords(act.reason)));
}

std::string Episode::ActionName(int action) const {
  const auto& actions = talk_.view().task()->actions;
  const auto index = static_cast<std::size_t>(action);
  return index < actions.size() ? actions[index].name : "action " + std::to_string(action);
}

void Episode::AddSeconds(const char* phase, Clock::time_point since) {
  record_.phase_seconds[phase] += std::chrono::duration<double>(Clock::now() - since).count();
}

}  // namespace prospect::services
