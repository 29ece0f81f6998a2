#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/dataset.h"

namespace prospect::model {

/// One frame that training uses. Its position in SampleSet::frames is its *slot*, by which caches
/// of pictures and encodings are indexed.
struct FrameRef {
  int trial = 0;  ///< index into SampleSet::trials
  int frame = 0;  ///< frame number inside the trial
};

/// One carried-out action. Labels as in docs/training.md: the goal picture is the frame on which
/// the next segment begins, or the trial's last.
struct SegmentSample {
  int trial = 0;
  int action = 0;
  int previous = 0;       ///< the action before it, or the null action
  int start = 0;          ///< slot of the segment's first frame
  int goal = 0;           ///< slot of the goal picture
  bool succeeded = true;  ///< did it meet its end condition (f's label on the goal picture)
  std::vector<int>
      mids;  ///< slots of frames inside, at least 0.3 s before the end (f's label there is 0)
};

struct TrialSample {
  std::uint64_t seed = 0;
  std::size_t index = 0;  ///< in the TrialFile
  Split split = Split::kTrain;
  bool succeeded = false;    ///< V's and Q's label
  int first = 0;             ///< slot of the trial's first frame (x0)
  std::vector<int> present;  ///< per action: p's label, before the action just done is excluded
  int first_segment = 0;     ///< index into SampleSet::segments
  int segments = 0;
};

/// What training reads of a data set: which frames, and their labels. Everything is a pure function
/// of the labels on disk. A plain value.
struct SampleSet {
  std::string task, world_version, task_hash;
  int width = 0, height = 0, num_actions = 0;
  std::vector<std::vector<int>> successors;  ///< as Trial::successors
  int num_landmarks = 0;                     ///< K; 0: the data set does not say where things are
  /// frames x K x 2, as Trial::landmarks; infinite in frames of trials that do not say where things
  /// are
  std::vector<float> landmarks;
  std::vector<TrialSample> trials;
  std::vector<SegmentSample> segments;
  std::vector<FrameRef> frames;

  /// Trials of one part, as indices into `trials`; those without a single action are left out.
  std::vector<int> TrialsOf(Split split) const;
  /// Segments of one part, as indices into `segments`.
  std::vector<int> SegmentsOf(Split split) const;
  /// Slots of one part.
  std::vector<int> FramesOf(Split split) const;
};

/// Where a segment lies in its trial.
struct SegmentSpan {
  int first = 0;  ///< its first frame
  int goal = 0;   ///< the frame of its goal picture: the next segment's first, or the trial's last
};

/// The spans of all segments of a trial.
std::vector<SegmentSpan> SegmentSpans(const Trial& trial);

/// Reads all labels and chooses the frames: each trial's first, each segment's start and goal, and
/// `mids_per_segment` inside it. Throws DataError.
SampleSet ReadSamples(const TrialFile& file, int mids_per_segment);

/// Adds one trial; ReadSamples is this over a file.
void AddTrial(const Trial& trial, std::size_t index, int mids_per_segment, SampleSet* set);

/// p's label of action `next` after `previous` (num_actions: at the start): the scene offers it and
/// the task's graph lets it follow. (That an object was visited earlier in a plan is the task's
/// rule, which the planner applies.)
bool MayFollow(const SampleSet& set, const TrialSample& trial, int previous, int next);

}  // namespace prospect::model
