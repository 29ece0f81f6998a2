#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/image.h"
#include "sim/suturing/suturing_task.h"

namespace prospect::tools {

// A gesture of a trial that was carried out: frames from 1, both included.
struct GestureSpan {
  int first = 0;
  int last = 0;
  int gesture = 0;  // action index
};

struct GestureTrial {
  std::vector<GestureSpan> spans;
  int frames = 0;
  std::string reason;  // why it failed; empty: it succeeded
};

// Lets the simulated surgeon do trial `seed`: waits a moment, then one gesture after the other as
// the chain of sim/suturing/gestures.h has it, then waits a moment. `attempt` varies everything but
// the scene. `on_frame` is called for every frame, 1 to GestureTrial::frames, while `task` shows
// it; it may be empty. The same seed and attempt give the same trial.
GestureTrial PlayGestureTrial(sim::SuturingTask* task, std::uint64_t seed, int attempt,
                              const std::function<void(int)>& on_frame);

// The transcription's text: a line "FIRST LAST Gk " a gesture.
std::string TranscriptionText(const GestureTrial& trial);

}  // namespace prospect::tools
