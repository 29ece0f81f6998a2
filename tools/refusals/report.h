#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tools/refusals/splits.h"

namespace prospect::tools {

/// What is measured of one calibration sample.
struct RefusalOptions {
  double alpha = 0.05;
  double epsilon = 0.1;
  double delta = 0.1;
  int splits = 20;
  std::uint64_t seed = 0;
};

/// The figures of one sample, with the keys that docs/json.md documents: task, scenes, solvable,
/// hopeless, doubtful, auroc, area, coverage_at_5, coverage_at_10, refuse and fail (target, mean,
/// standard_error, within, kept; rates, thresholds and bands of those kept), curve and success;
/// stopped and wanted (splits).
nlohmann::json MeasureRefusals(const model::CalibrationSample& sample, const std::string& task,
                               const RefusalOptions& options);

/// The same as a table for a person.
std::string RefusalTable(const nlohmann::json& figures);

}  // namespace prospect::tools
