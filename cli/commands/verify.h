#pragma once

#include <string>

#include "cli/fwd.h"
#include "cli/options/report.h"

namespace prospect::cli {

/// Measures again the figures that docs/results.md gives for the bundled weights.
struct VerifyOptions {
  std::string figures;   ///< what to measure and what is said of it; empty: config/figures.yaml
  std::string weights;   ///< folder of TASK.safetensors; empty: the bundled ones
  std::string held_out;  ///< folder of TASK.h5; empty: the bundled ones
  std::string work;      ///< folder for trials and reports; empty: $PROSPECT_DATA/verify
  bool full = false;     ///< everything, as in docs/results.md: hours
  int jobs = 0;          ///< processes; 0: all cores
  ReportOptions report;
};

void Define(CLI::App& app, VerifyOptions& options);

}  // namespace prospect::cli
