#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/fwd.h"
#include "cli/options/report.h"

namespace prospect::cli {

/// What `prospect merge` has read from the parts of a run.
struct MergedParts {
  std::string made_of;               ///< JSON: what records depend on besides the options
  std::vector<std::string> records;  ///< of all items of the run, in their order
};

/// Which share of a run this process does; the other ones are done by other processes, perhaps on
/// other machines, and `prospect merge` puts them together.
struct ShardOptions {
  int index = 0;  ///< from 1 to `count`; 0: the whole run
  int count = 0;
  /// What else was asked that the outcome depends on, by name: "--scenes=100".
  std::vector<std::string> asked;
  /// By prospect merge alone: nothing is run, the records are these. Null: items are run.
  std::shared_ptr<const MergedParts> merged;

  bool given() const { return index > 0; }
};

/// Adds --shard I/N. What is asked is gathered when `app` has parsed; both must live until then.
void DefineShard(CLI::App& app, ShardOptions& shard);

/// What is wrong with --shard in a command that writes its part to --json; empty: nothing.
std::string ShardDefect(const ShardOptions& shard, const ReportOptions& report);

}  // namespace prospect::cli
