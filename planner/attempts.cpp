#include "planner/attempts.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace prospect::planner {
namespace {

bool MayComeFirst(const TaskRules& rules, int action) {
  const std::vector<int>& first = rules.successors.back();
  return std::find(first.begin(), first.end(), action) != first.end();
}

// Where the unfinished part of a plan began: at the latest action that may come first.
std::size_t UnfinishedSince(const TaskRules& rules, const Path& executed) {
  std::size_t begin = executed.size();
  while (begin > 0 && !MayComeFirst(rules, executed[begin - 1])) --begin;
  return begin == 0 ? 0 : begin - 1;
}

}  // namespace

bool MayBeginAnew(const TaskRules& rules, const Path& executed) {
  if (executed.empty()) return false;
  const std::vector<int>& next = rules.successors.at(executed.back());
  const auto first = [&](int action) { return MayComeFirst(rules, action); };
  return std::any_of(next.begin(), next.end(), first) &&
         !std::all_of(next.begin(), next.end(), first);
}

Attempt BegunAnew(const TaskRules& rules, const Attempt& attempt) {
  if (!MayBeginAnew(rules, attempt.executed))
    throw std::invalid_argument("nothing can be begun anew here");
  const std::size_t since = UnfinishedSince(rules, attempt.executed);
  Attempt anew;
  anew.executed.assign(attempt.executed.begin(),
                       attempt.executed.begin() + static_cast<std::ptrdiff_t>(since));
  anew.executed.push_back(attempt.executed.back());
  anew.plan_length = attempt.plan_length + 1;
  return anew;
}

TaskRules RulesFor(TaskRules rules, const Attempt& attempt) {
  if (rules.plan_length == attempt.plan_length) return rules;
  rules.plan_length = attempt.plan_length;
  rules.Prepare();
  return rules;
}

bool CanBeDone(const TaskRules& rules, const Attempt& attempt) {
  return attempt.plan_length <= kMaxPathLength &&
         !RulesFor(rules, attempt).AllowedActions(attempt.executed, {}).empty();
}

Attempts::Attempts(TaskRules rules, int most, Disbelief disbelief, double below)
    : rules_(std::move(rules)),
      most_(most),
      disbelief_(disbelief),
      below_(below),
      attempt_{{}, rules_.plan_length} {}

NextStep Attempts::Next(const SearchFor& search, double surprise) {
  earlier_ = std::max(earlier_, surprise);
  const bool surprised = surprise > disbelief_.now || earlier_ > disbelief_.earlier;
  NextStep next;
  next.plan = search(attempt_);
  const bool believed = next.plan.ok() && (!surprised || MayWait(next.plan.best.path));
  if (MayBeginAnewNow() && (!believed || next.plan.best.score < below_)) {
    const Attempt anew = BegunAnew(rules_, attempt_);
    Plan plan = search(anew);
    if (plan.ok() && (!believed || plan.best.score > next.plan.best.score)) {
      next = {NextStep::Kind::kAnew, -1, std::move(plan), next.plan.best.score};
      if (surprised) next.surprise = surprise > disbelief_.now ? surprise : earlier_;
      attempt_ = anew;
      earlier_ = 0;
      ++begun_anew_;
    }
  }
  if (next.plan.ok() && !next.plan.best.path.empty()) {
    if (next.kind != NextStep::Kind::kAnew) next.kind = NextStep::Kind::kAct;
    Follow(next.plan.best.path);
  } else if (MayStill() && RestLeadsToANewBeginning()) {
    next.kind = NextStep::Kind::kCarryOn;
  }
  if (next.kind != NextStep::Kind::kGiveUp) next.action = rest_.front();
  return next;
}

void Attempts::Follow(const Path& path) {
  if (path != rest_) followed_ = 0;
  rest_ = path;
}

bool Attempts::MayBeginAnewNow() const {
  return MayStill() && MayBeginAnew(rules_, attempt_.executed) &&
         CanBeDone(rules_, BegunAnew(rules_, attempt_));
}

bool Attempts::heeds_surprises() const {
  if (begun_anew_ >= most_) return false;
  for (int action = 0; action < rules_.num_actions; ++action) {
    if (MayBeginAnew(rules_, {static_cast<std::uint8_t>(action)})) return true;
  }
  return false;
}

void Attempts::CarriedOut(int action) {
  attempt_.executed.push_back(static_cast<std::uint8_t>(action));
  if (MayComeFirst(rules_, action)) earlier_ = 0;  // the next tower, say, after a finished one
  if (!rest_.empty() && rest_.front() == action) {
    rest_.erase(rest_.begin());
    ++followed_;
  } else {
    rest_.clear();
    followed_ = 0;
  }
}

bool Attempts::complete() const {
  return static_cast<int>(attempt_.executed.size()) >= attempt_.plan_length;
}

bool Attempts::MayStill() const { return begun_anew_ < most_ && !attempt_.executed.empty(); }

// Whether the plan's next action leads to where one may begin anew as well as now.
bool Attempts::MayWait(const Path& rest) const {
  return rest.size() > 1 && MayBeginAnew(rules_, {rest.front()});
}

// Where one may begin anew now and would not, one would not later either.
bool Attempts::RestLeadsToANewBeginning() const {
  return !MayBeginAnew(rules_, attempt_.executed) &&
         std::any_of(rest_.begin(), rest_.end(),
                     [&](std::uint8_t action) { return MayBeginAnew(rules_, {action}); });
}

}  // namespace prospect::planner
