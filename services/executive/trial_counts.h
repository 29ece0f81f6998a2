#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "agent/record.h"
#include "lcmtypes/messages.h"

namespace prospect::services {

/// What became of trials that are being collected, kept in a file so that collecting goes on where
/// it was left. Plain data; one thread.
class TrialCounts {
 public:
  /// Of trials with this table whose first one is of this seed: those that `path` counts, or none
  /// where there is no such file. Throws ExitError: kExitDataFile for a damaged file, kExitUsage
  /// for one of another table or seed.
  TrialCounts(const std::string& path, const task_t& task, std::int64_t first_seed);

  void Add(const agent::EpisodeRecord& record);
  /// Writes the file. Throws base::DiskError.
  void Write() const;

  std::int64_t episodes() const { return episodes_; }
  std::int64_t solved() const;
  /// Keys: task, task_hash, first_seed, episodes, outcomes {word: n}, actions [{name, tried,
  /// succeeded}] in the table's order.
  nlohmann::json ToJson() const;
  /// A line an action, for people.
  std::string Table() const;

 private:
  struct Row {
    std::string name;
    std::int64_t tried = 0, succeeded = 0;
  };

  void Read(const nlohmann::json& file);

  std::string path_, task_, task_hash_;
  std::int64_t first_seed_, episodes_ = 0;
  std::map<std::string, std::int64_t> outcomes_;
  std::vector<Row> rows_;
};

}  // namespace prospect::services
