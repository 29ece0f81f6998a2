#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "tools/recordings/conversion.h"

namespace prospect::tools {

struct FromVideoOptions {
  std::string folder;
  std::string out;                    // the data set to write
  int every = 0;                      // one frame in so many is kept; 0: one a tick of the task
  std::vector<std::string> held_out;  // model::segments::AssignParts
};

// A folder of videos (video_folder.h) to a data set. A trial that cannot be used is left out, one
// that can be put right is repaired, each with a line to `say`. The frame before the first action
// is kept, too, as the picture in which nothing is done yet; transcriptions of JIGSAWS begin with
// the first gesture. Throws as Conversion does.
ConversionReport FromVideo(const tasks::TaskFile& task, const FromVideoOptions& options,
                           const Conversion::Say& say, const std::atomic<bool>* stop);

}  // namespace prospect::tools
