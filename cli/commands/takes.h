#pragma once

#include <cstdint>
#include <string>

#include "cli/fwd.h"
#include "cli/options/common.h"
#include "cli/options/report.h"
#include "cli/options/scene.h"
#include "cli/options/task.h"

namespace prospect::cli {

struct TakesOptions {
  std::string task = DefaultTask();
  std::uint64_t seed = kFirstReportedSeed;  ///< first scene
  int scenes = 20;                          ///< a random trial each
  SceneOptions scene;
  int most_actions = 40;  ///< of a trial
  ReportOptions report;
};

void Define(CLI::App& app, TakesOptions& options);
std::string Defect(const TakesOptions& options);

}  // namespace prospect::cli
