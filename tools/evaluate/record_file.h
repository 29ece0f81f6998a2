#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace prospect::tools {

// Records of scenes on disk, a line a scene, so that a run that was cut short goes on where it was.
// The first line says what the records depend on. Only ever appended to, a line in one write;
// damaged lines are skipped. One process, one thread.
class RecordFile {
 public:
  // `path` need not exist, its folder is made. Throws std::invalid_argument when the file was made
  // with another `key`, base::DiskError when it cannot be written.
  RecordFile(const std::string& path, const nlohmann::json& key);

  const std::map<std::uint64_t, nlohmann::json>& records() const { return records_; }

  // `record` has its scene under "seed".
  void Store(const nlohmann::json& record);

 private:
  std::string path_;
  std::map<std::uint64_t, nlohmann::json> records_;
};

}  // namespace prospect::tools
