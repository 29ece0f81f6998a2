#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "model/jigsaws/hold_out.h"
#include "tools/common/extent.h"

namespace prospect::tools {

struct JigsawsOptions {
  std::string root;    // holds the task's folder
  std::string folder;  // the task's folder as distributed, such as "Suturing"
  std::string out;     // the data set to write
  int every = 10;      // one frame in so many is kept, besides each gesture's first and the last
  model::jigsaws::HoldOut hold_out;
};

struct JigsawsReport {
  std::size_t trials = 0, repaired = 0, left_out = 0;
  std::int64_t frames = 0;
};

// Reads a task's folder in the layout of JIGSAWS (transcriptions/, video/NAME_capture1.avi; what
// else is there is not read, but that simulated.json marks videos of a simulation) into one data
// set, trial by trial, in memory that does not grow. A trial that cannot be used is left out, one
// that can be put right is repaired, each with one line to `say`. Throws model::DataError if no
// trial is left, model::DiskError, std::invalid_argument as model::jigsaws::AssignParts does,
// Interrupted (tools/common/extent.h) once `*stop` is set.
JigsawsReport ConvertJigsaws(const JigsawsOptions& options,
                             const std::function<void(const std::string&)>& say,
                             const std::atomic<bool>* stop);

}  // namespace prospect::tools
