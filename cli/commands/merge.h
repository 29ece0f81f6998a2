#pragma once

#include <string>
#include <vector>

#include "cli/fwd.h"

namespace prospect::cli {

/// What `prospect merge` is asked for.
struct MergeOptions {
  std::vector<std::string> parts;  ///< files that one command has written with --shard
  std::string out;                 ///< data set or report, as one process would have written it
  bool quiet = false;
};

void Define(CLI::App& app, MergeOptions& options);

}  // namespace prospect::cli
