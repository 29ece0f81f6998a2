#include "planner/task_rules.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace prospect::planner {
namespace {

template <typename List>
bool Contains(const List& list, int action) {
  return std::find(list.begin(), list.end(), action) != list.end();
}

void Require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("task rules: " + what);
}

// Each action after each, and after none.
std::size_t TransitionsOf(int num_actions) {
  const auto actions = static_cast<std::size_t>(num_actions);
  return (actions + 1) * actions;
}

}  // namespace

bool GoalRules::Met(std::uint8_t facts) const {
  return std::all_of(required.begin(), required.end(),
                     [facts](std::uint8_t mask) { return (mask & facts) != 0; });
}

void TowerRules::Validate(int num_actions) const {
  if (empty()) return;
  const auto states = static_cast<std::size_t>(num_states);
  Require(num_states >= 1 && stands.size() == states,
          "tower.stands needs one entry for each state");
  Require(handovers.size() == TransitionsOf(num_actions),
          "tower.handovers needs one entry for each action after each and after none");
  Require(num_handovers >= 1 && next.size() == states * static_cast<std::size_t>(num_handovers),
          "tower.next needs one entry for each hand-over in each state");
  Require(
      std::all_of(handovers.begin(), handovers.end(), [&](int h) { return h <= num_handovers; }),
      "tower.handovers names one that does not exist");
  Require(std::all_of(next.begin(), next.end(), [&](int state) { return state < num_states; }),
          "tower.next names a state that does not exist");
}

bool TaskRules::Complete(const Path& executed, const Path& path) const {
  return static_cast<int>(executed.size() + path.size()) >= plan_length;
}

void TaskRules::Prepare() {
  Validate();
  const std::vector<int>& first = successors.back();
  std::vector<bool> now;
  for (int action = 0; action < num_actions; ++action) {
    const std::vector<int>& next = successors[static_cast<std::size_t>(action)];
    now.push_back(std::all_of(next.begin(), next.end(), [&](int a) { return Contains(first, a); }));
  }
  finishes.assign(1, now);
  for (int steps = 1; steps < plan_length; ++steps) {
    const std::vector<bool> later = finishes.back();
    for (int action = 0; action < num_actions; ++action) {
      const std::vector<int>& next = successors[static_cast<std::size_t>(action)];
      now[static_cast<std::size_t>(action)] = std::any_of(
          next.begin(), next.end(), [&](int a) { return later[static_cast<std::size_t>(a)]; });
    }
    finishes.push_back(now);
  }
  PrepareEnds();
}

// The same backwards as for `finishes`, for each state of the tower and each set of facts apart.
void TaskRules::PrepareEnds() {
  brings_about.clear();
  if (goal.empty() && tower.empty()) return;
  for (int steps = 0; steps < plan_length; ++steps) {
    std::vector<bool> now;
    for (int action = 0; action < num_actions; ++action) {
      for (int state = 0; state < tower.num_states; ++state) {
        for (int facts = 0; facts < 1 << goal.num_facts; ++facts)
          now.push_back(EndsWell(action, {static_cast<std::uint8_t>(facts), state}, steps));
      }
    }
    brings_about.push_back(std::move(now));
  }
}

// Whether a plan can end `steps` actions after `action` with the goal met and in one tower, when
// `here` holds after it. Fewer steps are known.
bool TaskRules::EndsWell(int action, const Standing& here, int steps) const {
  if (steps == 0) {
    return finishes[0][static_cast<std::size_t>(action)] && goal.Met(here.facts) &&
           (tower.empty() || tower.stands[static_cast<std::size_t>(here.tower)]);
  }
  const std::vector<int>& next = successors[static_cast<std::size_t>(action)];
  return std::any_of(next.begin(), next.end(), [&](int a) {
    return BringsAbout(action, a, here, static_cast<std::size_t>(plan_length - steps));
  });
}

std::size_t TaskRules::StandingIndex(int action, const Standing& standing) const {
  const auto state = static_cast<std::size_t>(action) * static_cast<std::size_t>(tower.num_states) +
                     static_cast<std::size_t>(standing.tower);
  return state << goal.num_facts | standing.facts;
}

TaskRules::Standing TaskRules::Apply(int previous, int action, Standing standing) const {
  const auto edge = static_cast<std::size_t>(previous) * static_cast<std::size_t>(num_actions) +
                    static_cast<std::size_t>(action);
  if (!goal.empty()) {
    const GoalRules::Effect& effect = goal.effects.at(edge);
    standing.facts = static_cast<std::uint8_t>((standing.facts & ~effect.clears) | effect.sets);
  }
  const int handover = tower.empty() ? 0 : tower.handovers.at(edge);
  if (handover > 0) {
    standing.tower = tower.next.at(
        static_cast<std::size_t>(standing.tower * tower.num_handovers + handover - 1));
  }
  return standing;
}

// What holds after `executed` and the first `length` actions of `path`. Makes no lists.
TaskRules::Standing TaskRules::StandingAfter(const Path& executed, const Path& path,
                                             std::size_t length) const {
  Standing standing;
  int previous = num_actions;
  const auto carry_out = [&](int action) {
    standing = Apply(previous, action, standing);
    previous = action;
  };
  std::for_each(executed.begin(), executed.end(), carry_out);
  std::for_each_n(path.begin(), length, carry_out);
  return standing;
}

// Whether `action` as number `steps` of a plan (from 0), after `previous` and with `before` before
// it, leads to an end with the goal met and in one tower.
bool TaskRules::BringsAbout(int previous, int action, const Standing& before,
                            std::size_t steps) const {
  return brings_about[static_cast<std::size_t>(plan_length) - steps - 1]
                     [StandingIndex(action, Apply(previous, action, before))];
}

// Out of line, so that deciding without a goal or a tower costs what it did.
[[gnu::noinline]] bool TaskRules::LeadsToAnEnd(const Path& executed, const Path& path,
                                               std::size_t length, int action) const {
  const int previous = length > 0         ? path[length - 1]
                       : executed.empty() ? num_actions
                                          : executed.back();
  return BringsAbout(previous, action, StandingAfter(executed, path, length),
                     executed.size() + length);
}

bool TaskRules::GoalMet(const Path& executed, const Path& path) const {
  return goal.empty() || goal.Met(StandingAfter(executed, path, path.size()).facts);
}

bool TaskRules::Allowed(const Path& executed, const Path& path, int action) const {
  return AllowedAfter(executed, path, path.size(), action);
}

// Of `path` only the first `length` actions are looked at. Asked for every path that is heard, so
// it makes no lists.
bool TaskRules::AllowedAfter(const Path& executed, const Path& path, std::size_t length,
                             int action) const {
  const std::size_t steps = executed.size() + length;
  if (static_cast<int>(steps) >= plan_length) return false;
  const int latest = length > 0         ? path[length - 1]
                     : executed.empty() ? num_actions
                                        : executed.back();
  const std::vector<int>& row = successors.at(static_cast<std::size_t>(latest));
  const auto taken = [&](int a) {
    const auto end = path.begin() + static_cast<std::ptrdiff_t>(length);
    return !repeats_allowed && (Contains(executed, a) || std::find(path.begin(), end, a) != end);
  };
  if (!Contains(row, action) || taken(action)) return false;
  if (finishes.empty()) return true;
  const std::vector<bool>& ends = finishes.at(static_cast<std::size_t>(plan_length) - steps - 1);
  const auto leads_to_an_end = [&](int a) {
    return brings_about.empty() ? ends[static_cast<std::size_t>(a)]
                                : LeadsToAnEnd(executed, path, length, a);
  };
  if (leads_to_an_end(action)) return true;
  return goal.empty() && std::none_of(row.begin(), row.end(),
                                      [&](int a) { return leads_to_an_end(a) && !taken(a); });
}

std::vector<int> TaskRules::AllowedActions(const Path& executed, const Path& path) const {
  std::vector<int> actions = Following(executed, path);
  if (actions.empty() || finishes.empty()) return actions;
  const std::vector<bool>& ends =
      finishes.at(static_cast<std::size_t>(plan_length) - executed.size() - path.size() - 1);
  const auto leads_nowhere = [&](int action) {
    return brings_about.empty() ? !ends[static_cast<std::size_t>(action)]
                                : !LeadsToAnEnd(executed, path, path.size(), action);
  };
  if (!goal.empty() || !std::all_of(actions.begin(), actions.end(), leads_nowhere)) {
    std::erase_if(actions, leads_nowhere);
  }
  return actions;
}

// What the table allows, ascending.
std::vector<int> TaskRules::Following(const Path& executed, const Path& path) const {
  std::vector<int> actions;
  if (Complete(executed, path)) return actions;
  const Path& latest = path.empty() ? executed : path;
  actions = successors.at(latest.empty() ? num_actions : latest.back());
  std::sort(actions.begin(), actions.end());
  actions.erase(std::unique(actions.begin(), actions.end()), actions.end());
  const auto taken = [&](int action) {
    return Contains(executed, action) || Contains(path, action);
  };
  if (!repeats_allowed) std::erase_if(actions, taken);
  return actions;
}

bool TaskRules::Legal(const Path& executed, const Path& path) const {
  for (std::size_t length = 0; length < path.size(); ++length) {
    if (!AllowedAfter(executed, path, length, path[length])) return false;
  }
  return true;
}

void TaskRules::Validate() const {
  Require(num_actions >= 1 && num_actions <= kMaxActions, "num_actions must be 1 to 255");
  Require(plan_length >= 1 && plan_length <= kMaxPathLength, "plan_length must be 1 to 64");
  Require(static_cast<int>(successors.size()) == num_actions + 1,
          "successors needs one row for each action and a last one for the null action");
  for (const std::vector<int>& row : successors) {
    for (const int action : row) {
      Require(action >= 0 && action < num_actions, "successors name an action that does not exist");
    }
  }
  tower.Validate(num_actions);
  if (goal.empty()) return;
  Require(goal.num_facts >= 1 && goal.num_facts <= GoalRules::kMaxFacts,
          "goal.num_facts must be 1 to 8");
  Require(goal.effects.size() == TransitionsOf(num_actions),
          "goal.effects needs one entry for each action after each and after none");
}

TaskRules AnyOrder(int num_actions, int plan_length, bool repeats_allowed) {
  TaskRules rules;
  rules.num_actions = num_actions;
  rules.plan_length = plan_length;
  rules.repeats_allowed = repeats_allowed;
  std::vector<int> all(std::max(num_actions, 0));
  std::iota(all.begin(), all.end(), 0);
  rules.successors.assign(all.size() + 1, all);
  rules.Prepare();
  return rules;
}

}  // namespace prospect::planner
