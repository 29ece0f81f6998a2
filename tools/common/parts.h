#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/exit_error.h"
#include "cli/options/shard.h"

namespace prospect::tools {

// Of which run something is a part: what --shard leaves in its file, for `prospect merge`.
//
// Item k of a run, from 0, belongs to part 1 + k modulo the number of parts.
struct Part {
  int index = 1;  // from 1 to `count`
  int count = 1;
  std::string command;               // "evaluate calibrate"
  std::vector<std::string> options;  // that the outcome depends on: "--scenes=100"
  nlohmann::json made_of;            // what else it depends on, by name: world_version, weights
  int items = 0;                     // of the whole run
  std::string version;               // of Prospect
};

// A part and where it was read.
struct NamedPart {
  std::string file;
  Part part;
};

// A part's file that cannot be used, or parts that are not all those of one run. The message names
// the file.
class PartError : public ExitError {
 public:
  explicit PartError(const std::string& what) : ExitError(kExitDataFile, what) {}
};

// The numbers of the items that this process does, ascending. Throws std::invalid_argument where
// there are fewer items than parts.
std::vector<int> ItemsOf(const cli::ShardOptions& shard, int items);

// What the process that does `shard` of `items` items makes.
Part PartOf(const cli::ShardOptions& shard, const std::string& command, int items,
            const nlohmann::json& made_of);

nlohmann::json ToJson(const Part& part);
// `text`: of ToJson(), which stands in `file`. Throws PartError.
Part PartFrom(const std::string& text, const std::string& file);

// How many items a part has.
int SizeOf(const Part& part);

// Throws PartError unless these are all the parts of one run, each once, in any order, and made by
// this version.
void RequireOneRun(const std::vector<NamedPart>& parts);

// The file of a part that is a report: {"part": ToJson, "records": [...]}, one of each item, in
// their order. Throws base::DiskError.
void WriteRecords(const std::string& file, const Part& part,
                  const std::vector<nlohmann::json>& records);

// The parts of one run, put together.
struct MergedRun {
  std::string command;
  std::vector<std::string> options;
  cli::MergedParts parts;
};
// Reads files of WriteRecords(). Throws PartError as RequireOneRun(), and for a file that is
// missing, damaged, or no part.
MergedRun ReadRecords(const std::vector<std::string>& files);

}  // namespace prospect::tools
