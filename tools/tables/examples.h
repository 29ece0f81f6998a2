#pragma once

#include <vector>

#include "model/trial.h"

namespace prospect::tools {

/// One example of the paper's tables: the picture of a frame, the action under way there and the
/// one after it, and the frames that show their ends.
struct Example {
  int frame = 0;
  int action1 = 0, goal1 = 0;
  int action2 = 0, goal2 = 0;
};

/// The examples of one trial, in the order of frames: every `every`-th frame during an action
/// (1: all of them, at the trial's own rate). In the last segment there is no second action; its
/// frames are left out, or, with `paper_tail`, take the first action and goal again, as the
/// authors' code did. every >= 1.
std::vector<Example> ExamplesOf(const model::Trial& trial, int every, bool paper_tail);

}  // namespace prospect::tools
