#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/fwd.h"
#include "cli/options/report.h"
#include "cli/options/shard.h"
#include "cli/options/task.h"
#include "cli/options/trial_scenes.h"

namespace prospect::cli {

/// What `prospect collect` is asked for.
struct CollectOptions {
  std::string task = DefaultTask();
  std::string format = "hdf5";  ///< or "jigsaws": videos and transcriptions in JIGSAWS' layout
  std::optional<int> trials;    ///< left out: 100; jigsaws: 39, as JIGSAWS has
  std::uint64_t seed = 0;       ///< trial i has seed + i; all must lie in 0..999,999
  std::string out;              ///< FILE.h5; jigsaws: a folder
  TrialSceneOptions scenes;
  double image_noise =
      0.01;                 ///< sigma as a share of full range; hdf5: stored, the frames are clean
  double foresight = 0;     ///< hdf5: share of the actions that are tried out before
  int jobs = 2;             ///< processes
  bool resume = false;      ///< go on where an earlier, killed run of the same command stopped
  bool keep_parts = false;  ///< hdf5: the files of single trials stay

  // jigsaws:
  int frames_per_second = 15;  ///< a divisor of 30; JIGSAWS has 30
  int width = 128;             ///< pixels; JIGSAWS has 640 x 480
  int height = 96;
  bool right_eye = false;  ///< write NAME_capture2.avi, too
  bool failures =
      false;           ///< keep trials that fail; otherwise they are done again until they succeed
  ShardOptions shard;  ///< hdf5
  ReportOptions report;
};

void Define(CLI::App& app, CollectOptions& options);
std::string Defect(const CollectOptions& options);

}  // namespace prospect::cli
