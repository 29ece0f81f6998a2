#pragma once

#include <cstdint>
#include <string>

#include "cli/fwd.h"
#include "cli/options/report.h"
#include "cli/options/scene.h"
#include "cli/options/shard.h"
#include "cli/options/task.h"

namespace prospect::cli {

struct OracleOptions {
  std::string task = DefaultTask();
  int scenes = 100;
  std::uint64_t seed = 1'000'000;  ///< of the first scene; scene i has seed + i
  SceneOptions scene;
  int jobs = 2;        ///< processes
  std::string cache;   ///< folder; empty: $PROSPECT_DATA/oracle or ~/.cache/prospect/oracle
  bool fresh = false;  ///< consult anew, write no cache
  ShardOptions shard;
  ReportOptions report;
};

void Define(CLI::App& app, OracleOptions& options);
std::string Defect(const OracleOptions& options);

}  // namespace prospect::cli
