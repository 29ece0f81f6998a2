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

}  // namespace

bool GoalRules::Met(std::uint8_t facts) const {
  return std::all_of(required.begin(), required.end(),
                     [facts](std::uint8_t mask) { return (mask & facts) != 0; });
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
  PrepareGoal();
}

// The same backwards as for `finishes`, for each set of facts apart.
void TaskRules::PrepareGoal() {
  brings_about.clear();
  if (goal.empty()) return;
  const int sets = 1 << goal.num_facts;
  for (int steps = 0; steps < plan_length; ++steps) {
    std::vector<bool> now;
    for (int action = 0; action < num_actions; ++action) {
      const std::vector<int>& next = successors[static_cast<std::size_t>(action)];
      for (int facts = 0; facts < sets; ++facts) {
        const auto held = static_cast<std::uint8_t>(facts);
        const auto leads = [&](int a) {
          return BringsAbout(action, a, held, static_cast<std::size_t>(plan_length - steps));
        };
        now.push_back(steps == 0 ? finishes[0][static_cast<std::size_t>(action)] && goal.Met(held)
                                 : std::any_of(next.begin(), next.end(), leads));
      }
    }
    brings_about.push_back(std::move(now));
  }
}

std::uint8_t TaskRules::Apply(int previous, int action, std::uint8_t facts) const {
  const GoalRules::Effect& effect =
      goal.effects.at(static_cast<std::size_t>(previous * num_actions + action));
  return static_cast<std::uint8_t>((facts & ~effect.clears) | effect.sets);
}

// The facts that hold after `executed` and the first `length` actions of `path`. Makes no lists.
std::uint8_t TaskRules::FactsAfter(const Path& executed, const Path& path,
                                   std::size_t length) const {
  std::uint8_t facts = 0;
  int previous = num_actions;
  const auto carry_out = [&](int action) {
    facts = Apply(previous, action, facts);
    previous = action;
  };
  std::for_each(executed.begin(), executed.end(), carry_out);
  std::for_each_n(path.begin(), length, carry_out);
  return facts;
}

// Whether `action` as number `steps` of a plan (from 0), after `previous` and with `facts` before
// it, leads to an end with the goal met.
bool TaskRules::BringsAbout(int previous, int action, std::uint8_t facts, std::size_t steps) const {
  const auto after = static_cast<std::size_t>(action) << goal.num_facts;
  return brings_about[static_cast<std::size_t>(plan_length) - steps - 1]
                     [after | Apply(previous, action, facts)];
}

// Out of line, so that deciding without a goal costs what it did.
[[gnu::noinline]] bool TaskRules::LeadsToGoal(const Path& executed, const Path& path,
                                              std::size_t length, int action) const {
  const int previous = length > 0         ? path[length - 1]
                       : executed.empty() ? num_actions
                                          : executed.back();
  return BringsAbout(previous, action, FactsAfter(executed, path, length),
                     executed.size() + length);
}

bool TaskRules::GoalMet(const Path& executed, const Path& path) const {
  return goal.empty() || goal.Met(FactsAfter(executed, path, path.size()));
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
  if (!brings_about.empty()) {
    return LeadsToGoal(executed, path, length, action);
  }
  if (finishes.empty()) return true;
  const std::vector<bool>& ends = finishes.at(static_cast<std::size_t>(plan_length) - steps - 1);
  const auto leads_to_an_end = [&](int a) {
    return ends[static_cast<std::size_t>(a)] && !taken(a);
  };
  return ends[static_cast<std::size_t>(action)] ||
         std::none_of(row.begin(), row.end(), leads_to_an_end);
}

std::vector<int> TaskRules::AllowedActions(const Path& executed, const Path& path) const {
  std::vector<int> actions = Following(executed, path);
  if (actions.empty() || finishes.empty()) return actions;
  if (!brings_about.empty()) {
    const auto fails = [&](int a) { return !LeadsToGoal(executed, path, path.size(), a); };
    actions.erase(std::remove_if(actions.begin(), actions.end(), fails), actions.end());
    return actions;
  }
  const std::vector<bool>& ends =
      finishes.at(static_cast<std::size_t>(plan_length) - executed.size() - path.size() - 1);
  const auto leads_nowhere = [&](int action) { return !ends[static_cast<std::size_t>(action)]; };
  if (!std::all_of(actions.begin(), actions.end(), leads_nowhere)) {
    actions.erase(std::remove_if(actions.begin(), actions.end(), leads_nowhere), actions.end());
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
  if (!repeats_allowed) {
    actions.erase(std::remove_if(actions.begin(), actions.end(), taken), actions.end());
  }
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
  Require(plan_length >= 1 && plan_length <= kMaxPathLength, "plan_length must be 1 to 32");
  Require(static_cast<int>(successors.size()) == num_actions + 1,
          "successors needs one row for each action and a last one for the null action");
  for (const std::vector<int>& row : successors) {
    for (const int action : row) {
      Require(action >= 0 && action < num_actions, "successors name an action that does not exist");
    }
  }
  if (goal.empty()) return;
  Require(goal.num_facts >= 1 && goal.num_facts <= GoalRules::kMaxFacts,
          "goal.num_facts must be 1 to 8");
  Require(goal.effects.size() == static_cast<std::size_t>((num_actions + 1) * num_actions),
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
