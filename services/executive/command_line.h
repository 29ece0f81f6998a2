#pragma once

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
  prospect::cli::ReportOptions report;
};

/// Reads the arguments: those of cli/commands/executive.h, which `prospect` hands on, and those
/// that only programs and measurements give. @return the status to end with, if that is all; what
/// is wrong has been told
std::optional<int> ParseExecutive(int argc, char** argv, ExecutiveCall* call);

}  // namespace prospect::services
