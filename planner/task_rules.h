// What a task allows, apart from any learned model: which action may follow which, whether an
// action may be repeated, after how many actions the task's plan is complete, and how it can end.
// The search masks what the rules exclude, so that no network is asked about it. Plain data; const
// member functions are safe from any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "planner/path.h"

namespace prospect::planner {

// What a plan must bring about, as facts that actions set and clear: a handful, so that those that
// hold are the bits of a byte.
struct GoalRules {
  static constexpr int kMaxFacts = 8;

  struct Effect {
    std::uint8_t sets = 0;    // facts that hold once the action was carried out
    std::uint8_t clears = 0;  // facts that no longer hold then
  };

  int num_facts = 0;
  // [previous * num_actions + action]: what `action` does directly after `previous` (num_actions:
  // when it comes first).
  std::vector<Effect> effects;
  // The goal is met while at least one fact of each of these masks holds.
  std::vector<std::uint8_t> required;

  // No goal: nothing is asked.
  bool empty() const { return required.empty(); }
  bool Met(std::uint8_t facts) const;
};

// How a tower grows, for tasks that build one: the states of what is stacked and which hand-over of
// one block to another leads from which to which. See OneTower in tower.h.
struct TowerRules {
  int num_states = 1;  // 0: nothing is stacked
  // [state]: all that is stacked can be one tower, so a plan may end in it.
  std::vector<bool> stands;
  // [previous * num_actions + action]: which hand-over `action` completes directly after `previous`
  // (num_actions: when it comes first); 0: none.
  std::vector<std::uint16_t> handovers;
  int num_handovers = 0;  // those that there are: 1 to num_handovers
  // [state * num_handovers + handover - 1]: the state after it.
  std::vector<std::uint16_t> next;

  // The task builds no tower.
  bool empty() const { return handovers.empty(); }
  // As TaskRules::Validate.
  void Validate(int num_actions) const;
};

struct TaskRules {
  // Number of actions, 1 to kMaxActions; actions are 0 to num_actions - 1.
  int num_actions = 0;
  // Actions in a complete plan, counted from the episode's start (executed ones included), 1 to
  // kMaxPathLength.
  int plan_length = 0;
  // Row i lists the actions that may follow action i; row num_actions those that may come first
  // (null action).
  std::vector<std::vector<int>> successors;
  // False: an action that was executed, or that stands earlier in the path, may not be taken again.
  bool repeats_allowed = false;
  // [r][a]: whether a plan can end r actions after a. Filled by Prepare(); empty: any action ends a
  // plan.
  std::vector<std::vector<bool>> finishes;
  // What a plan may stack on what; empty: anything. See OneTower in tower.h.
  TowerRules tower;
  // What a plan must bring about beyond that; empty: nothing. See SetGoal in goal.h.
  GoalRules goal;
  // [r][(a * tower.num_states + tower's state) << goal.num_facts | facts]: whether a plan can end r
  // actions after a with the goal met and in one tower, when that state and `facts` hold after a.
  // Filled by Prepare() where there is a tower or a goal.
  std::vector<std::vector<bool>> brings_about;

  // To be called when the fields above are set and whenever they change. A plan ends with an action
  // after which one begins anew: whatever may follow it may also come first, as when an arm is back
  // home. Where a plan of plan_length actions can still end so, with its blocks in one tower where
  // the task builds one, only what leads there is allowed; where it cannot (an action failed in the
  // middle), anything the table allows. With a goal there is no such leniency: only what leads to
  // an end with the goal met is allowed (where repeats are not, as far as the table alone can
  // tell).
  void Prepare();

  // `executed`: actions already carried out before this root, oldest first. `path`: actions
  // imagined from the root. False also when the plan is complete. `action` outside the table is
  // never allowed.
  bool Allowed(const Path& executed, const Path& path, int action) const;

  // All allowed actions, ascending. Empty when the plan is complete or the rules lead nowhere.
  std::vector<int> AllowedActions(const Path& executed, const Path& path) const;

  // True when executed and path together are a plan of plan_length actions.
  bool Complete(const Path& executed, const Path& path) const;

  // True when every action of `path`, taken in turn, is allowed.
  bool Legal(const Path& executed, const Path& path) const;

  // Whether executed and path, in turn, brought the goal about. True where there is none.
  bool GoalMet(const Path& executed, const Path& path) const;

  // Throws std::invalid_argument naming the field that is wrong and the range it must have.
  void Validate() const;

 private:
  // What holds at some point of a plan.
  struct Standing {
    std::uint8_t facts = 0;  // of the goal
    int tower = 0;           // state
  };

  void PrepareEnds();
  bool EndsWell(int action, const Standing& here, int steps) const;
  std::size_t StandingIndex(int action, const Standing& standing) const;
  Standing Apply(int previous, int action, Standing standing) const;
  Standing StandingAfter(const Path& executed, const Path& path, std::size_t length) const;
  bool BringsAbout(int previous, int action, const Standing& before, std::size_t steps) const;
  bool LeadsToAnEnd(const Path& executed, const Path& path, std::size_t length, int action) const;
  bool AllowedAfter(const Path& executed, const Path& path, std::size_t length, int action) const;
  std::vector<int> Following(const Path& executed, const Path& path) const;
};

// Rules in which any action may follow any other (and itself, if repeats are allowed): the
// navigation task.
TaskRules AnyOrder(int num_actions, int plan_length, bool repeats_allowed = false);

}  // namespace prospect::planner
