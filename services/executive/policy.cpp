#include "services/executive/policy.h"

#include <sstream>
#include <stdexcept>

#include "services/binding/task_messages.h"
#include "sim/random.h"

namespace prospect::services {
namespace {

constexpr char kPlanPrefix[] = "plan:";
// The stream of the collector's choices (tools/collect); the test of recorded against collected
// trials holds the two together.
constexpr std::uint64_t kPlanStream = 0x706c616eULL;

std::vector<int> Legal(const planner::TaskRules& rules, const label_t& label,
                       const planner::Path& done) {
  std::vector<int> legal;
  for (const int action : rules.AllowedActions(done, {})) {
    if (label.present.at(static_cast<std::size_t>(action)) == 1) legal.push_back(action);
  }
  return legal;
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
  if (policy == "search" || policy == "collect") return "";
  if (policy.rfind(kPlanPrefix, 0) == 0) {
    try {
      ParsePlan(policy);
      return "";
    } catch (const std::exception&) {
      return "'" + policy + "' is no plan: give action indices, as in plan:0,2,1";
    }
  }
  return "unknown policy '" + policy + "'; known: search, collect, plan:0,2,1";
}

std::vector<int> CollectPlan(const task_t& task, const label_t& label, std::uint64_t seed) {
  const auto rules = RulesFromTask(task);
  sim::Random random(sim::MixSeeds({seed, kPlanStream}));
  planner::Path done;
  for (auto legal = Legal(rules, label, done); !legal.empty(); legal = Legal(rules, label, done)) {
    const int action =
        legal[static_cast<std::size_t>(random.Below(static_cast<int>(legal.size())))];
    done.push_back(static_cast<std::uint8_t>(action));
  }
  return {done.begin(), done.end()};
}

}  // namespace prospect::services
