#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "sim/oracle.h"

namespace prospect::sim {

// What one oracle consultation depends on, besides the seed.
struct OracleKey {
  std::string task;           // "navigation"
  std::string world_version;  // TaskSpec::world_version
  int objects = 4;
  int legs = 3;          // actions in a complete plan
  std::string goal{};    // empty: the task's own
  bool ordered = false;  // some legal plans are not tried: no tower can come of them
};

// What the oracle's answers for `task`, made with `objects`, depend on.
OracleKey OracleKeyOf(const Task& task, int objects);

// Oracle results on disk, one file of JSON lines a key, one line a scene seed: consulting the
// oracle costs seconds a scene and its answer never changes for one world. Files are only ever
// appended to, a line in one write, so several processes may share them; damaged lines (a killed
// writer) are skipped.
//
// Threads: safe to call from several threads.
class OracleCache {
 public:
  // `directory` is made if need be. Empty: $PROSPECT_DATA/oracle, or ~/.cache/prospect/oracle if
  // that is not set. Throws base::DiskError if it cannot be made. What a file of the same name in
  // `bundled` holds is known, too; nothing is written there.
  explicit OracleCache(const OracleKey& key, std::string directory = "",
                       const std::string& bundled = "");

  std::optional<OracleResult> Find(std::uint64_t scene_seed) const;
  void Store(std::uint64_t scene_seed, const OracleResult& result);

  const std::string& path() const { return path_; }

 private:
  void Load(const std::string& path);

  std::string path_;
  mutable std::mutex mutex_;
  std::map<std::uint64_t, OracleResult> results_;
};

// ConsultOracle through a cache: resets `task` to `scene_seed` and leaves it there.
OracleResult ConsultOracleCached(Task& task, std::uint64_t scene_seed, OracleCache& cache);

}  // namespace prospect::sim
