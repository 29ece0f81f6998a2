#include "tools/dataset/action_table.h"

namespace prospect::tools {

ActionTable::ActionTable(const sim::TaskSpec* spec) {
  if (spec == nullptr) return;
  for (const sim::ActionSpec& action : spec->actions) names_.push_back(action.name);
  successors_ = spec->successors;
}

std::string ActionTable::Name(int action) const {
  const auto index = static_cast<std::size_t>(action);
  return index < names_.size() ? names_[index] : "action " + std::to_string(action);
}

bool ActionTable::HasRetry(const model::Trial& trial) const {
  if (successors_.empty()) return false;
  int before = trial.null_action();
  for (std::size_t i = 1; i < trial.actions.size(); ++i) {
    if (trial.segment[i] == trial.segment[i - 1]) continue;
    if (trial.segment[i] > 0 && sim::IsRetry(successors_, before, trial.actions[i])) return true;
    before = trial.actions[i];
  }
  return false;
}

}  // namespace prospect::tools
