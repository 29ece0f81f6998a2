#pragma once

#include <atomic>
#include <string>

#include "tools/recordings/conversion.h"

namespace prospect::tools {

struct FromRobomimicOptions {
  std::string file;      // demonstrations
  std::string segments;  // CSV: which actions ran when (model/segments/segment_csv.h)
  std::string camera;    // whose pictures; empty: the only ones
  std::string out;       // the data set to write
  int every = 1;         // one picture in so many is kept
};

// Demonstrations in robomimic's layout, of which pictures and masks are read, to a data set. Kept
// pictures are a tick of the task apart; those of another size are scaled, with a line to `say`. A
// demonstration of which `segments` says nothing, or that cannot be used, is left out with a line.
// demo_N has the number N. Throws as Conversion does.
ConversionReport FromRobomimic(const tasks::TaskFile& task, const FromRobomimicOptions& options,
                               const Conversion::Say& say, const std::atomic<bool>* stop);

}  // namespace prospect::tools
