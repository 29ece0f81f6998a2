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
    return ends[static_cast<std::size_t>(a)] && !taken(a);
  };
  return ends[static_cast<std::size_t>(action)] ||
         std::none_of(row.begin(), row.end(), leads_to_an_end);
}

std::vector<int> TaskRules::AllowedActions(const Path& executed, const Path& path) const {
  std::vector<int> actions = Following(executed, path);
  if (actions.empty() || finishes.empty()) return actions;
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
