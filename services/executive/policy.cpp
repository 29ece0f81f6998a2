#include "services/executive/policy.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "planner/path.h"
#include "services/binding/task_messages.h"
#include "sim/random_plan.h"

namespace prospect::services {
namespace {

constexpr char kPlanPrefix[] = "plan:";

bool Contains(const std::vector<int>& list, int action) {
  return std::find(list.begin(), list.end(), action) != list.end();
}

// What may come next in a plan of `rules` after `done`, among the actions whose object is there.
std::vector<int> Legal(const planner::TaskRules& rules, const std::optional<label_t>& label,
                       const std::vector<int>& done) {
  std::vector<int> legal;
  for (const int action : rules.successors.at(done.empty() ? rules.num_actions : done.back())) {
    const bool fresh = rules.repeats_allowed || !Contains(done, action);
    const bool present = !label || label->present.at(static_cast<std::size_t>(action)) == 1;
    if (fresh && present) legal.push_back(action);
  }
  return legal;
}

// A plan that took a retry is longer than plan_length: it is over where nothing but a new beginning
// may follow.
bool Over(const planner::TaskRules& rules, const std::vector<int>& done) {
  if (done.size() < static_cast<std::size_t>(rules.plan_length)) return false;
  const std::vector<int>& first = rules.successors.back();
  const std::vector<int>& next = rules.successors.at(done.back());
  return done.size() >= planner::kMaxPathLength ||
         std::all_of(next.begin(), next.end(), [&](int action) { return Contains(first, action); });
}

}  // namespace

std::vector<int> ParsePlan(const std::string& policy) {
  std::vector<int> plan;
  std::istringstream text(policy.substr(sizeof kPlanPrefix - 1));
  for (std::string item; std::getline(text, item, ',');) {
    std::size_t used = 0;
    plan.push_back(std::stoi(item, &used));
    if (used != item.size() || plan.back() < 0) throw std::invalid_argument(item);
  }
  if (plan.empty()) throw std::invalid_argument("empty");
  return plan;
}

std::string PolicyDefect(const std::string& policy) {
  if (policy == "search" || policy == "collect" || policy == "expert") return "";
  if (policy.rfind(kPlanPrefix, 0) == 0) {
    try {
      ParsePlan(policy);
      return "";
    } catch (const std::exception&) {
      return "'" + policy + "' is no plan: give action indices, as in plan:0,2,1";
    }
  }
  return "unknown policy '" + policy + "'; known: search, collect, expert, plan:0,2,1";
}

std::vector<int> CollectPlan(const task_t& task, const std::optional<label_t>& label,
                             std::uint64_t seed, bool retries) {
  if (label && label->present.size() != task.actions.size())
    throw std::invalid_argument("LABEL tells of " + std::to_string(label->present.size()) +
                                " actions, TASK of " + std::to_string(task.actions.size()));
  const auto rules = RulesFromTask(task);
  sim::RandomPlan random(rules, seed, retries);
  std::vector<int> done;
  while (!Over(rules, done)) {
    const std::vector<int> legal = Legal(rules, label, done);
    if (legal.empty()) break;
    done.push_back(random.Choose(legal));
  }
  return done;
}

}  // namespace prospect::services
