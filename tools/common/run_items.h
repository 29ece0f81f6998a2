#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/options/report.h"
#include "cli/options/shard.h"
#include "tools/common/extent.h"

namespace prospect::tools {

// Numbered items whose records make a report.
struct Items {
  std::string what;  // the counted things, plural: "scenes"
  int count = 0;     // of the whole run
  int jobs = 1;
  nlohmann::json made_of;  // what a record depends on besides the options: world_version, weights
};

// The records of the items that were run, in the order of their numbers.
struct ItemRuns {
  std::vector<nlohmann::json> records;
  Extent extent;
};

// Runs the items of `shard`, or all, with ForkMap (fork_map.h), showing progress; where prospect
// merge has read their records from parts, nothing is run and these are returned. `note`, of a
// record that came just now, is shown beside the progress. Stopped, and throws, as ForkMap; throws
// std::invalid_argument with more parts than items, PartError where what a record depends on is
// not what it was when the parts were made.
ItemRuns RunItems(const cli::ShardOptions& shard, const Items& items,
                  const std::function<std::function<std::string(int)>()>& make_work,
                  const std::function<std::string(const nlohmann::json&)>& note = nullptr);

// Ends a run of one part: writes its records to --json. @return the exit status. Throws Interrupted
// where the run was stopped: a part is whole or none.
int WritePart(const cli::ShardOptions& shard, const cli::ReportOptions& report,
              const std::string& command, const Items& items, const ItemRuns& runs);

}  // namespace prospect::tools
