#pragma once

#include <cstdint>
#include <string>

#include "cli/fwd.h"
#include "cli/options/report.h"
#include "cli/options/shard.h"
#include "cli/options/task.h"
#include "cli/options/trial_scenes.h"

namespace prospect::cli {

/// Task, scenes and first seed as the data set was made with.
struct CeilingOptions {
  std::string task = DefaultTask();
  TrialSceneOptions scenes;
  int trials = 500;        ///< of the test part
  int runs = 10;           ///< repetitions from each moment, in each of three ways
  std::uint64_t seed = 0;  ///< of the first trial; only those of the test part count
  int jobs = 2;            ///< processes
  ShardOptions shard;
  ReportOptions report;
};

void Define(CLI::App& app, CeilingOptions& options);
std::string Defect(const CeilingOptions& options);

}  // namespace prospect::cli
