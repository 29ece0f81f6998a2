#include "planner/handovers.h"

#include <algorithm>

namespace prospect::planner {

std::vector<Handover> FindHandovers(const std::vector<ActionWords>& words, const TaskRules& rules) {
  std::vector<Handover> handovers;
  const std::vector<int>& first = rules.successors.back();
  for (std::size_t giver = 0; giver < words.size(); ++giver) {
    for (const int next : rules.successors[giver]) {
      const auto taker = static_cast<std::size_t>(next);
      const bool begins = std::find(first.begin(), first.end(), next) != first.end();
      if (!begins && words[giver].object != words[taker].object)
        handovers.push_back({giver, taker});
    }
  }
  return handovers;
}

}  // namespace prospect::planner
