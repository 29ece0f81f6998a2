#include "sim/rollout.h"

namespace prospect::sim {

bool RunAction(Task& task, int action, FrameSink* sink, int* ticks) {
  if (!task.StartAction(action)) return false;
  while (task.progress().action_state == ActionState::kRunning) {
    task.Tick();
    if (ticks != nullptr) ++*ticks;
    if (sink != nullptr) sink->OnFrame(task.Observe(), task.progress());
  }
  return true;
}

RolloutResult RunPlan(Task& task, const std::vector<int>& plan, FrameSink* sink) {
  RolloutResult result;
  const int done_before = task.progress().actions_done;
  if (sink != nullptr) sink->OnFrame(task.Observe(), task.progress());
  for (int action : plan) {
    if (task.progress().outcome != Outcome::kRunning) break;
    if (!RunAction(task, action, sink, &result.ticks)) {
      result.reason = "illegal_action";
      break;
    }
  }
  const Progress progress = task.progress();
  result.outcome = progress.outcome;
  if (!progress.reason.empty()) result.reason = progress.reason;
  result.actions_done = progress.actions_done - done_before;
  return result;
}

}  // namespace prospect::sim
