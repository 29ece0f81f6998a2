#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/options/report.h"
#include "services/common/common_options.h"
#include "services/executive/options.h"

namespace prospect::services {

/// What prospect-executive was told.
struct ExecutiveCall {
  CommonOptions common;
  ExecutiveOptions options;
  std::int64_t episodes = 0;  ///< trials to be collected in all; 0: a single episode
  bool pause = false;         ///< before each of them, until a person types Enter
  prospect::cli::ReportOptions report;
};

/// Reads the arguments: those of cli/commands/executive.h, which `prospect` hands on, and those
/// that only programs and measurements give. @return the status to end with, if that is all; what
/// is wrong has been told
std::optional<int> ParseExecutive(int argc, char** argv, ExecutiveCall* call);

}  // namespace prospect::services
