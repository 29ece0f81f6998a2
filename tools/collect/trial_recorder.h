#pragma once

#include <cstdint>

#include "model/trial.h"
#include "sim/rollout.h"
#include "sim/task.h"
#include "sim/task_factory.h"

namespace prospect::tools {

// Gathers a trial of a data set frame by frame while it is carried out. The first frame (label
// null) shows the scene before the first action; each later one is what the camera saw after a
// tick, labelled with the action of that tick. Images are kept clean. One thread.
class TrialRecorder : public sim::FrameSink {
 public:
  // `task` must outlive the recorder.
  TrialRecorder(const sim::Task& task, std::uint64_t seed);

  void OnFrame(const sim::Image& image, const sim::Progress& progress) override;

  // The trial so far, with its outcome, the objects present and the light.
  model::Trial Finish(double image_noise) const;

 private:
  const sim::Task& task_;
  model::Trial trial_;
};

// Carries out trial `seed` of `task`: a random legal plan (sim/random_plan.h). The choice of
// actions has a stream of its own, so it does not depend on the world's noise. `foresight`: share
// of the choices that are tried out before, with other noise and with what has to follow up to the
// next choice; the first that goes well is taken (and, where a tower is built, builds it).
// Of random plans of many actions few come far enough to fail late, or not at all.
model::Trial RecordRandomTrial(sim::Task& task, std::uint64_t seed, double image_noise,
                               double foresight = 0);

}  // namespace prospect::tools
