#pragma once

#include <iostream>
#include <nlohmann/json.hpp>

#include "base/json_file.h"
#include "cli/options/report.h"

namespace prospect::cli {

/// Writes a report as --json asks. Throws base::DiskError.
inline void WriteReport(const ReportOptions& options, const nlohmann::json& report) {
  if (options.json.empty()) return;
  if (options.json != "-") return base::WriteJsonFile(options.json, report);
  std::cout << report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
}

/// The same for one that is text already.
inline void WriteReport(const ReportOptions& options, const std::string& report) {
  if (options.json.empty()) return;
  if (options.json != "-") return base::WriteFile(options.json, report);
  std::cout << report << std::flush;
}

}  // namespace prospect::cli
