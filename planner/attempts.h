// Beginning anew. A plan may go wrong in the middle: a block slips out of the gripper, and what is
// left of the plan ends without a tower. Some tasks allow going back to the beginning before the
// plan is over: after `open` or `back_off` an arm may align itself with a block again, and tables
// of such tasks list an action there that may also come first, beside those that go on. Plans that
// are searched leave such steps out (a plan of the task's length has no room for them); this is
// who takes them. Plain data and pure functions of it: no clock, no bus, no model.
#pragma once

#include <functional>

#include "planner/path.h"
#include "planner/plan.h"
#include "planner/task_rules.h"

namespace prospect::planner {

// The part of an episode that a search looks at: what of the actions carried out still counts, and
// after how many actions (those included) the plan is complete.
struct Attempt {
  Path executed;
  int plan_length = 0;
};

// Whether after `executed` the table allows both going on and beginning anew.
bool MayBeginAnew(const TaskRules& rules, const Path& executed);

// `attempt` with its unfinished part begun anew: that part, from the latest action that may come
// first on, counts no more, but for its last action, which is what the next one follows. The plan
// is complete when it was made up for. Needs MayBeginAnew(rules, attempt.executed).
Attempt BegunAnew(const TaskRules& rules, const Attempt& attempt);

// `rules` for a search of this attempt: its plan_length, prepared for it.
TaskRules RulesFor(TaskRules rules, const Attempt& attempt);

// Whether the rules leave anything to begin anew with: an action that leads on to a complete plan,
// with the goal met where there is one, in no more actions than a path may have.
bool CanBeDone(const TaskRules& rules, const Attempt& attempt);

// What to do next, and the search that says so.
struct NextStep {
  enum class Kind {
    kAct,      // the first action of plan.best
    kAnew,     // the same; the plan begins anew with it
    kCarryOn,  // the plan is lost, but what is left of it leads to where one may begin anew
    kGiveUp,   // nothing: plan.reason says why
  };
  Kind kind = Kind::kGiveUp;
  int action = -1;      // to carry out; -1: none
  Plan plan;            // of the search that decided
  double going_on = 0;  // kAnew: what going on would have scored
  // kAnew: the surprise that decided it, now or after an earlier action; 0: the scores did.
  double surprise = 0;
};

// Above which surprise a plan is not believed any more. 0 to 1, however it is measured; 1: none.
struct Disbelief {
  double now = 1;      // of what is seen where one may begin anew
  double earlier = 1;  // of what was seen after any action of the part that may be begun anew
};

// Decides from one action to the next, over an episode. One thread.
class Attempts {
 public:
  // At most `most` times something is begun anew, and only where going on scores less than `below`
  // (0 to 1) or is not believed. 0 times: a plan that is lost is given up.
  Attempts(TaskRules rules, int most, Disbelief disbelief = {}, double below = 0.5);

  // Searches the attempt from the present picture.
  using SearchFor = std::function<Plan(const Attempt&)>;

  // Searches what is left of the attempt and acts on it, unless it is lost and something better can
  // be done: where one may begin anew, and a plan of the task (and its goal) is left, that is
  // searched, too, and taken if it scores more; on the way there the plan that was last acted on is
  // carried on, since its path was imagined free. Before the first action there is nothing of the
  // kind: a refusal stays a refusal. `surprise`: how far what is seen is from what the plan
  // imagined for now. Beyond Disbelief the score of going on is not believed, and whatever may be
  // begun anew is; but not before the last action that allows it, when all has been seen that there
  // is to see. What surprised after an earlier action is remembered until then: a block that was
  // never lifted is not on a tower, though a search that begins without it in the hand may find
  // another plan and surprise no more.
  NextStep Next(const SearchFor& search, double surprise = 0);

  // Whether a surprise would matter, now or later.
  bool heeds_surprises() const;
  // Actions carried out of the plan that is followed, since the search that first found it. A
  // search that finds its rest again follows it; one that finds another plan begins with 0.
  int followed() const { return followed_; }

  // `action` was carried out.
  void CarriedOut(int action);

  const Attempt& current() const { return attempt_; }
  int begun_anew() const { return begun_anew_; }
  // Whether the plan is complete.
  bool complete() const;

 private:
  void Follow(const Path& path);
  bool MayStill() const;
  bool MayBeginAnewNow() const;
  bool MayWait(const Path& rest) const;
  bool RestLeadsToANewBeginning() const;

  TaskRules rules_;
  int most_;
  Disbelief disbelief_;
  double below_;
  double earlier_ = 0;  // the greatest surprise of the unfinished part
  Attempt attempt_;
  Path rest_;  // of the plan last acted on
  int followed_ = 0;
  int begun_anew_ = 0;
};

}  // namespace prospect::planner
