#include "agent/goal.h"

#include "agent/plan_context.h"
#include "base/text.h"

namespace prospect::agent {

EpisodeGoal::EpisodeGoal(const std::string& text) {
  if (!text.empty()) atoms_ = planner::ParseGoal(text);
}

std::vector<std::string> EpisodeGoal::Atoms() const {
  std::vector<std::string> atoms;
  for (const auto& atom : atoms_) atoms.push_back(planner::ToString(atom));
  return atoms;
}

std::vector<std::string> EpisodeGoal::AtomsOf(const TaskView& task) const {
  std::vector<std::string> atoms;
  for (const auto& atom : planner::ResolveGoal(atoms_, task.goals))
    atoms.push_back(planner::ToString(atom));
  return atoms;
}

std::vector<std::string> EpisodeGoal::TermsFor(const TaskView& task) const {
  std::vector<std::string> terms;
  for (const auto& term : planner::TermsOf(atoms_, task.goals))
    terms.push_back(planner::ToString(term));
  return terms;
}

std::string EpisodeGoal::Defect(const TaskView& task,
                                const std::optional<SceneLabel>& label) const {
  if (empty()) return "";
  try {
    RulesFor(task);
  } catch (const planner::GoalError& error) {
    return error.what();
  }
  if (!label) return "";
  const auto present = ObjectsPresent(task, *label);
  for (const auto& atom : atoms_) {
    for (const auto& name : atom.arguments) {
      if (name != "*" && !present.contains(name))
        return "there is no " + name + " in this scene; there are: " + base::Joined(present);
    }
  }
  return "";
}

planner::TaskRules EpisodeGoal::RulesFor(const TaskView& task) const {
  planner::TaskRules rules = task.rules;
  planner::SetGoal(planner::TermsOf(atoms_, task.goals), &rules);
  return rules;
}

bool EpisodeGoal::Reached(const TaskView& task, const planner::Path& executed) const {
  return empty() || RulesFor(task).GoalMet(executed, {});
}

}  // namespace prospect::agent
