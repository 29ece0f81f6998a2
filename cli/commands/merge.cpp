#include "cli/commands/merge.h"

#include <CLI/CLI.hpp>

#include "cli/options/common.h"
#include "cli/options/report.h"

namespace prospect::cli {

void Define(CLI::App& app, MergeOptions& options) {
  app.footer(
      R"(PARTS are what one command has written with --shard 1/N to --shard N/N and otherwise the same
options; weights and scene files must be where they were. What comes out is what the command writes
without --shard: data sets byte for byte, reports figure for figure, but for times that were
measured. A part that is missing, comes twice, or was made with other options, by another version
or of another world is named, and nothing is written.)");
  app.add_option("PARTS", options.parts, "the parts of one run, in any order")->required();
  DefineOut(app, options.out, "the data set (HDF5) or report (JSON) to write", "FILE")->required();
  DefineQuiet(app, options.quiet);
}

}  // namespace prospect::cli
