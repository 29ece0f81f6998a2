#include "cli/options/report.h"

#include <CLI/CLI.hpp>

namespace prospect::cli {

void DefineReport(CLI::App& app, ReportOptions& report) {
  app.add_option("--json", report.json,
                 "write the report to this file, too; -: to standard output, in the place of words")
      ->type_name("FILE");
  DefineQuiet(app, report.quiet);
}

void DefineQuiet(CLI::App& app, bool& quiet) {
  app.add_flag("-q,--quiet", quiet, "say nothing but what is wrong");
}

}  // namespace prospect::cli
