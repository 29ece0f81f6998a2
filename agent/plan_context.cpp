#include "agent/plan_context.h"

#include <algorithm>

namespace prospect::agent {

std::string NameOf(int action, const PlanContext& context) {
  const auto index = static_cast<std::size_t>(action);
  return index < context.names.size() ? context.names[index] : "action " + std::to_string(action);
}

std::string StepText(std::size_t number, int action, const PlanContext& context) {
  return "step " + std::to_string(number) + ", " + NameOf(action, context);
}

std::vector<std::string> NamesOf(const std::vector<int>& actions, const PlanContext& context) {
  std::vector<std::string> names;
  for (const int action : actions) names.push_back(NameOf(action, context));
  return names;
}

std::vector<std::string> NamesOf(const planner::Path& path, const PlanContext& context) {
  return NamesOf(std::vector<int>(path.begin(), path.end()), context);
}

std::size_t SharedSteps(const planner::Path& a, const planner::Path& b) {
  const std::size_t most = std::min(a.size(), b.size());
  return static_cast<std::size_t>(
      std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(most), b.begin()).first -
      a.begin());
}

}  // namespace prospect::agent
