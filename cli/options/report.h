#pragma once

#include <string>

#include "cli/fwd.h"

namespace prospect::cli {

/// What becomes of a command's report.
struct ReportOptions {
  std::string json;    ///< file; "-": standard output, in the place of words; empty: none
  bool quiet = false;  ///< nothing is said but errors

  /// Whether tables and progress are printed.
  bool talks() const { return !quiet && json != "-"; }
};

/// Adds --json FILE and --quiet. Write the report with WriteReport (cli/report_file.h).
void DefineReport(CLI::App& app, ReportOptions& report);

/// Adds --quiet alone, for commands that report nothing.
void DefineQuiet(CLI::App& app, bool& quiet);

}  // namespace prospect::cli
