#include "tools/dataset/action_table.h"

#include <cstdio>
#include <stdexcept>

#include "base/hash.h"
#include "model/jigsaws/gestures.h"
#include "sim/task_factory.h"

namespace prospect::tools {

ActionTable::ActionTable(const model::Trial& trial) {
  if (model::jigsaws::IsGestureTask(trial.task) && trial.num_actions == model::jigsaws::kGestures) {
    for (int action = 0; action < model::jigsaws::kGestures; ++action) {
      names_.push_back(model::jigsaws::GestureName(action));
    }
    return;
  }
  try {
    const auto task = sim::MakeTask(trial.task);
    if (trial.task_hash != base::HexText(task->spec().Hash())) return;
    for (const sim::ActionSpec& action : task->spec().actions) names_.push_back(action.name);
    successors_ = task->spec().successors;
  } catch (const std::invalid_argument&) {
    // Somebody else's task: numbers will do.
  }
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
