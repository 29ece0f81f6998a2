#pragma once

#include <vector>

#include "sim/task.h"

namespace prospect::sim {

// Receives what the camera sees while a plan is carried out.
class FrameSink {
 public:
  virtual ~FrameSink() = default;

  // Called at the start (before the first action) and after every tick. `progress` is that of the
  // moment the picture shows: its `action` is the frame's label, and an action's last frame carries
  // its final action_state.
  virtual void OnFrame(const Image& image, const Progress& progress) = 0;
};

struct RolloutResult {
  Outcome outcome = Outcome::kRunning;  // kRunning if the plan ended before the trial did
  std::string reason;    // as Progress::reason; "illegal_action" if a step was refused
  int actions_done = 0;  // steps of the plan that succeeded
  int ticks = 0;
};

// Starts `action` and ticks until it ends. `sink` may be null, then nothing is rendered. Returns
// false, with the task unchanged, if the action is refused. Adds the ticks made to *ticks if that
// is not null.
bool RunAction(Task& task, int action, FrameSink* sink, int* ticks = nullptr);

// Carries `plan` out from the task's current state, one action after the other, until it ends or
// the trial is over. The first frame goes to the sink before the first action.
RolloutResult RunPlan(Task& task, const std::vector<int>& plan, FrameSink* sink);

}  // namespace prospect::sim
