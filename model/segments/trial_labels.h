#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/segments/segmentation.h"
#include "model/trial.h"

namespace prospect::model::segments {

/// The number that stands for a recorded trial of this name in data sets.
std::uint64_t NumberOfName(const std::string& name);

/// Which frames of a recording a data set keeps: from the trial's first frame every `every`-th, the
/// first frame of each action, and the last frame of the last action. So no goal picture is lost by
/// keeping fewer frames.
class KeptFrames {
 public:
  /// `every` is at least 1.
  KeptFrames(const Segmentation& segmentation, int every);
  bool Keeps(int frame) const;  ///< frames from 0
  int last() const { return last_; }
  /// How many frames it keeps of a whole recording.
  int Count() const;

 private:
  std::vector<int> begins_;  // ascending
  int first_, last_, every_;
};

/// Fills in the labels of a trial whose kept frames are `frames` (from 0, ascending). A frame
/// between two actions belongs to the one before it, so that an action's goal picture is the frame
/// on which the next one begins, and that of the last action its own last frame. Frames before the
/// first action belong to none. The trial has succeeded if its last action has.
void PutLabels(const Segmentation& segmentation, const std::vector<int>& frames, Trial* trial);

}  // namespace prospect::model::segments
