#include "sim/plan_rules.h"

#include <vector>

#include "planner/tower.h"

namespace prospect::sim {

planner::TaskRules PlanRules(const TaskSpec& spec) {
  planner::TaskRules rules;
  rules.num_actions = static_cast<int>(spec.actions.size());
  rules.plan_length = spec.plan_length;
  rules.successors = spec.successors;
  rules.repeats_allowed = spec.repeats_allowed;
  std::vector<planner::ActionWords> words;
  for (const ActionSpec& action : spec.actions) words.push_back({action.kind, action.object});
  rules.tower = planner::OneTower(words, rules);
  return rules;
}

}  // namespace prospect::sim
