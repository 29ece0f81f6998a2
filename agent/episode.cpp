#include "agent/episode.h"

#include <algorithm>
#include <stdexcept>

#include "agent/errors.h"
#include "agent/explanation.h"
#include "agent/phase_clock.h"
#include "agent/what_if.h"

namespace prospect::agent {
namespace {

using planner::NextStep;

constexpr char kNotComplete[] = "the plan was carried out and the task is not complete";

planner::Path NamedWhatIf(const EpisodeOptions& options, const TaskView& task) {
  if (options.what_if.empty()) return {};
  try {
    return NamedPlan(options.what_if, task.actions);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--what-if: ") + error.what());
  }
}

void ChooseRule(const std::string& calibrated, planner::SearchParameters* search) {
  if (!search->rule.empty()) return;
  search->UseRule(calibrated.empty() ? planner::SearchParameters().rule : calibrated);
}

}  // namespace

Episode::Episode(World& world, Mind* mind, const EpisodeOptions& options, Listener& listener)
    : world_(world), mind_(mind), options_(options), listener_(listener), goal_(options.goal) {
  record_.goal = goal_.Atoms();
  record_.seed = world.seed();
  record_.policy = options.policy;
}

EpisodeRecord Episode::Run() {
  Prepare();
  const std::string defect = goal_.Defect(world_.task(), world_.label());
  if (defect.empty()) record_.goal = goal_.AtomsOf(world_.task());
  if (!defect.empty()) {
    Verdict("refused", "the goal cannot be brought about: " + defect);
    ExplainUnsearched();
  } else if (refusals_ && !refusals_->may_attempt()) {
    record_.terms = refusals_->Terms(options_, !goal_.empty());
    Verdict("refused", refusals_->promises().back());
    ExplainUnsearched();
  } else if (options_.plan) {
    RunGivenPlan();
  } else {
    RunSearches();
  }
  return Conclude();
}

EpisodeRecord Episode::Stopped(const std::string& reason) {
  Verdict("stopped", reason);
  return Conclude();
}

void Episode::Prepare() {
  PhaseClock waiting(&record_.phase_seconds["services"]);
  world_.Await();
  waiting.Stop();
  what_if_ = NamedWhatIf(options_, world_.task());  // before a scene is set up for it
  PhaseClock looking(&record_.phase_seconds["look"]);
  first_ = latest_ = world_.Begin();
  looking.Stop();
  LearnScene();
}

void Episode::LearnScene() {
  const TaskView& task = world_.task();
  const std::optional<SceneLabel> label = world_.label();
  const model::SceneKind kind = KindOf(task, label ? &*label : nullptr);
  MindInfo info;
  if (!options_.plan) {
    info = mind_->Choose();
    refusals_.emplace(*mind_, info, options_, kind, listener_);
    ChooseRule(refusals_->rule(), &options_.search);
    record_.not_covered = refusals_->not_covered();
  }
  record_.task = task.name;
  record_.world_version = task.world_version;
  record_.plan_length = task.rules.plan_length;
  record_.objects = kind.objects;
  record_.frames_per_second = task.frames_per_second;
  record_.first = first_.picture;
  record_.seed = world_.seed();
  record_.engine = info.engine;
  record_.weights = info.weights;
}

void Episode::RunSearches() {
  deliberation_.emplace(*mind_, world_.task(), goal_, options_, *refusals_, what_if_, listener_,
                        &record_);
  for (;;) {
    SearchRecord search;
    const NextStep next = deliberation_->Decide(first_, latest_, &search);
    if (record_.searches.empty()) FirstSearched(search);
    record_.searches.push_back(search);
    listener_.PlanChanged(record_);
    if (next.kind == NextStep::Kind::kGiveUp)
      return Verdict(record_.acts.empty() ? "refused" : "stopped", search.reason);
    if (options_.explain_only) return Verdict("explained", "");
    if (options_.open_loop) return FollowBlindly(next.plan.best.path);
    if (!Act(next.action)) return;
  }
}

void Episode::FollowBlindly(const planner::Path& plan) {
  for (const int action : plan) {
    if (!Act(action)) return;
  }
  Verdict("stopped", kNotComplete);
}

void Episode::RunGivenPlan() {
  const std::vector<int> plan = options_.plan();
  given_steps_ = plan.size();
  for (const int action : plan) {
    if (!Act(action)) return;
  }
  Verdict("stopped", "the given plan ended before the task was complete");
}

// When nobody knows how far an action came, the record tells that it was begun.
ActionResult Episode::CarryOut(int action) {
  try {
    return world_.CarryOut(action);
  } catch (const std::exception& error) {
    ActRecord act;
    act.action = action;
    act.name = world_.task().ActionName(action);
    act.observed = "unknown";
    act.reason = error.what();
    record_.acts.push_back(act);
    throw;
  }
}

// Returns whether the episode goes on.
bool Episode::Act(int action) {
  const TaskView& task = world_.task();
  PhaseClock acting(&record_.phase_seconds["act"]);
  const double begun = latest_.seconds;
  const ActionResult result = CarryOut(action);
  if (result.state == ActionState::kRefused) {
    Verdict(record_.acts.empty() ? "failed" : "stopped",
            task.ActionName(action) + " was refused: " + result.reason);
    return false;
  }
  record_.acts.emplace_back();  // before the look, which may fail
  ActRecord& act = record_.acts.back();
  act.action = action;
  act.name = task.ActionName(action);
  act.observed = ToString(result.state);
  act.reason = result.reason;
  latest_ = world_.Look();
  acting.Stop();
  act.sim_seconds = latest_.seconds - begun;
  act.picture = latest_.picture;
  if (deliberation_) deliberation_->CarriedOut(action);
  if (!record_.searches.empty()) listener_.PlanChanged(record_);
  TellOf(act);

  if (result.state != ActionState::kSucceeded) {
    const std::string why = act.reason.empty() ? "" : ": " + task.CauseWords(act.reason);
    Verdict(result.state == ActionState::kFailed ? "failed" : "stopped",
            act.name + " " + act.observed + why);
    return false;
  }
  return GoesOn(result);
}

// After an action that succeeded. A robot that judges no outcome has solved its task when its plan
// is carried out; one that does is asked.
bool Episode::GoesOn(const ActionResult& result) {
  const bool complete =
      deliberation_ ? deliberation_->attempts().complete()
                    : static_cast<int>(record_.acts.size()) >= world_.task().rules.plan_length;
  if (result.outcome == TrialOutcome::kFailure) {
    Verdict("failed", world_.task().CauseWords(result.reason));
  } else if (result.outcome == TrialOutcome::kSuccess ||
             (complete && result.outcome == TrialOutcome::kUnknown)) {
    const bool reached = GoalReached();
    Verdict(reached ? "solved" : "failed", reached ? "" : "goal not reached");
  } else if (complete && deliberation_) {
    Verdict("stopped", kNotComplete);
  } else {
    return true;
  }
  return false;
}

// By all that was carried out, or by what was since the plan was begun anew: a plan may have been
// taken for lost that was not.
bool Episode::GoalReached() const {
  planner::Path all;
  for (const auto& act : record_.acts) all.push_back(static_cast<std::uint8_t>(act.action));
  const TaskView& task = world_.task();
  return goal_.Reached(task, all) ||
         (deliberation_ && goal_.Reached(task, deliberation_->attempts().current().executed));
}

// Of a plan that is not to be carried out nobody says how it would fare.
void Episode::FirstSearched(const SearchRecord& search) {
  record_.terms = refusals_->Terms(options_, !goal_.empty());
  if (search.act) record_.confidence = refusals_->ConfidenceIn(search.score);
  FinishExplanation(search);
}

// When the safeguards have been asked, too.
void Episode::FinishExplanation(const SearchRecord& search) {
  if (!record_.explanation) return;
  Explanation& explanation = *record_.explanation;
  explanation.act = search.act;
  explanation.reason = search.reason;
  explanation.terms = record_.terms;
  explanation.confidence = record_.confidence;
  explanation.familiarity = record_.familiarity;
  // No plan lost by what it was imagined to do.
  if (record_.familiarity && record_.familiarity->foreign()) explanation.chosen.why.clear();
}

// Refused without a search.
void Episode::ExplainUnsearched() {
  if (!options_.explain) return;
  Explanation explanation;
  explanation.reason = record_.reason;
  explanation.terms = record_.terms;
  NameScene(record_, &explanation);
  record_.explanation = std::move(explanation);
}

EpisodeRecord Episode::Conclude() {
  record_.frames = world_.Frames();
  return std::move(record_);
}

void Episode::Verdict(const std::string& outcome, const std::string& reason) {
  record_.outcome = outcome;
  record_.reason = reason;
}

// "3/9 grasp(green): succeeded"
void Episode::TellOf(const ActRecord& act) const {
  std::size_t steps = given_steps_;
  if (deliberation_) {
    const planner::Attempt& attempt = deliberation_->attempts().current();
    const auto plan_length = static_cast<std::size_t>(attempt.plan_length);
    steps = record_.acts.size() + plan_length - std::min(attempt.executed.size(), plan_length);
  }
  const std::string why = act.reason.empty() ? "" : ", " + world_.task().CauseWords(act.reason);
  listener_.Tell(std::to_string(record_.acts.size()) + "/" + std::to_string(steps) + " " +
                 act.name + ": " + act.observed + why);
}

}  // namespace prospect::agent
