#pragma once

#include <cstdint>
#include <string>

namespace prospect::services {

/// What repeating a worker's journal came to.
struct JournalReplay {
  std::int64_t searches = 0;
  std::int64_t heard = 0;        ///< messages fed in
  std::int64_t advances = 0;     ///< times that rollouts moved
  std::int64_t selections = 0;   ///< paths that it then asked for
  std::int64_t sent = 0;         ///< messages of rows made
  std::int64_t differences = 0;  ///< advances and messages that came out otherwise
  std::string first_difference;  ///< in words; empty: none
  std::uint64_t table = 0;       ///< TableHash of the last search
};

/// Repeats each step of a worker's --journal with the same times and compares what the search then
/// chose, path by path, and the rows it sent, byte by byte.
/// @throws ExitError (kExitDataFile) when the file cannot be read or is no journal
JournalReplay ReplayJournal(const std::string& path);

}  // namespace prospect::services
