#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace prospect::services {

/// One message of a log, as lcm-logger wrote it, without the tag of a deployment's key.
struct LogEvent {
  std::int64_t utime = 0;  ///< when it was logged, microseconds since the epoch
  std::string channel;
  std::vector<std::uint8_t> bytes;
};

/// Reads an LCM event log and survives damage: a logger that was killed leaves half an event at the
/// end, a bad disk leaves worse. What is no event is skipped up to the next sync word and counted.
/// (LCM's own reader trusts the lengths in the file and allocates what they say.) Format: LCM's
/// documentation, "Log File Format"; all numbers big-endian: sync word 0xEDA1DA01, int64 event
/// number, int64 time, int32 length of the channel, int32 length of the data, channel, data. Not
/// thread-safe.
class EventLog {
 public:
  /// @throws ExitError (kExitDataFile) when the file cannot be opened or holds no event at all
  explicit EventLog(const std::string& path);

  /// Reads the next whole event. @return false at the end of the file
  bool Next(LogEvent& event);

  std::int64_t events() const { return events_; }
  /// Stretches of bytes that were no whole event, the cut tail included.
  std::int64_t damaged() const { return damaged_; }

 private:
  bool ReadAt(std::int64_t offset, LogEvent& event);
  bool SeekSync();

  std::ifstream file_;
  std::int64_t size_ = 0;
  std::int64_t offset_ = 0;
  std::int64_t events_ = 0;
  std::int64_t damaged_ = 0;
};

}  // namespace prospect::services
