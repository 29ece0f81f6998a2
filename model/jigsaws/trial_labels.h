#pragma once

#include <string>
#include <vector>

#include "model/jigsaws/transcription.h"
#include "model/trial.h"

namespace prospect::model::jigsaws {

/// "Suturing_B001": the trial's user B and number 1.
struct TrialName {
  std::string text;
  char user = 'A';
  int number = 0;

  /// The seed that stands for it in data sets: one a user and number.
  std::uint64_t seed() const;
};

/// Takes a name apart. Throws DataError if it is not FOLDER_XNNN, X from A to Z, NNN digits.
TrialName ParseTrialName(const std::string& folder, const std::string& text);

/// Which frames of a video a data set keeps: from the first gesture's first frame every `every`-th,
/// the first frame of each gesture, and the last frame of the last gesture. So no goal picture is
/// lost by keeping fewer frames.
class KeptFrames {
 public:
  /// `every` is at least 1.
  KeptFrames(const Transcription& transcription, int every);
  bool Keeps(int frame) const;  ///< frames from 1
  int first() const { return first_; }
  int last() const { return last_; }
  /// How many frames it keeps of a whole video.
  int Count() const;

 private:
  std::vector<int> begins_;  // ascending
  int first_, last_, every_;
};

/// The labels of a trial whose kept frames are `frames` (from 1, ascending, the first gesture's
/// first frame first). A frame between two gestures belongs to the one before it, so that a
/// gesture's goal picture is the frame on which the next one begins, and that of the last gesture
/// its own last frame. Everything but task, world_version, name, seed and split is filled in.
/// @param seconds_per_frame of the video
Trial LabelsOf(const Transcription& transcription, const std::vector<int>& frames, int every,
               double seconds_per_frame);

}  // namespace prospect::model::jigsaws
