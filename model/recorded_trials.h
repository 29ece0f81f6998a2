#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "model/dataset.h"
#include "model/engine.h"
#include "model/novelty.h"

/// What the networks say of trials that were recorded, beside what came of them: needs no simulator
/// and no libtorch.
namespace prospect::model {

/// From where on a search gives a future up (planner::SearchParameters).
struct GivenUpBelow {
  double done = 0.1, value = 0.02, possible = 0.01;
};

/// One action of a recorded trial.
struct RecordedStep {
  int action = 0;
  bool succeeded = false;
  float done = 0;        ///< f of the state imagined from the picture before the action
  float done_ahead = 0;  ///< f of the same action, imagined from the trial's first picture on
};

/// One recorded trial as a search would have seen it from the first picture.
struct RecordedTrial {
  std::uint64_t seed = 0;
  bool succeeded = false;
  int plan_length = 0;
  double score = 0;       ///< of what was carried out: V after its last action times f of each
  bool given_up = false;  ///< a search would not have followed it to its end
  std::vector<RecordedStep> steps;
  NoveltySample first;  ///< of the first picture
};

/// Mean absolute difference, 0..1, of imagined pictures and those that were recorded.
struct ImaginedError {
  double all = 0;      ///< over all pixels
  double changed = 0;  ///< over those that the actions changed by 0.1 or more in some channel
  double copied = 0, copied_changed = 0;  ///< of the unchanged picture, for comparison
  std::size_t pictures = 0;
};

struct RecordedTrials {
  std::vector<RecordedTrial> trials;
  ImaginedError after_one, after_two;  ///< from the picture before the first of these actions
};

/// Trials that none of the networks has learned from: of the valid and test parts of the file, or
/// all of them. Those without a single action are left out.
std::vector<std::size_t> HeldOutTrials(const TrialFile& file, bool all);

/// Asks the networks about these trials of the file. `progress` is called after each. Throws
/// DataError; WeightsError where the engine was made for another task, table or picture size.
RecordedTrials JudgeRecorded(Engine& engine, const TrialFile& file,
                             const std::vector<std::size_t>& trials, const GivenUpBelow& limits,
                             const std::function<void()>& progress = nullptr);

}  // namespace prospect::model
