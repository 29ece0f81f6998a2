#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>

#include "cli/commands/collect.h"

namespace prospect::tools {

// Simulated suturing trials in the layout in which JIGSAWS is distributed (Gao et al. 2014):
//
//   OUT/README.txt                                  says that all of it is simulated
//   OUT/Suturing/video/Suturing_B001_capture1.avi   the left eye, Motion JPEG
//   OUT/Suturing/transcriptions/Suturing_B001.txt   a line "FIRST LAST Gk " a gesture
//   OUT/Suturing/meta_file_Suturing.txt             a line a trial, as there; skill and scores are
//   0 OUT/Suturing/simulated.json                     from what it was made
//
// Names are those of JIGSAWS' 39 suturing trials: users B to I, five trials each, without H002.
// Frames count from 1, both ends of a gesture belong to it, and each gesture begins on the frame
// after the one before ends; the frames before the first and after the last have no label.

struct GestureVideoSummary {
  int trials = 0;
  int kept = 0;                         // of these, trials that an earlier run had finished
  std::map<std::string, int> failures;  // trials that failed, kept or done again, by reason
  std::int64_t frames = 0;
  double simulated_seconds = 0;
  double wall_seconds = 0;
};

// "B001" to "I005": the name of trial `i`, 0 to 38.
std::string GestureTrialName(int i);

// Writes all trials. A trial's files get their names when they are whole, the transcription last.
// Throws CollectUsageError (collector.h) for options that do not fit, std::runtime_error (disk).
GestureVideoSummary CollectGestureVideos(const cli::CollectOptions& options);

}  // namespace prospect::tools
