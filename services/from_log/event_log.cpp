#include "services/from_log/event_log.h"

#include <array>

#include "base/exit_error.h"
#include "services/common/authenticity.h"

namespace prospect::services {
namespace {

constexpr std::uint32_t kSyncWord = 0xEDA1DA01;
constexpr std::int64_t kHeaderBytes = 28;
constexpr std::int64_t kLongestChannel = 63;  // LCM's limit

std::uint64_t BigEndian(const std::uint8_t* bytes, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value = (value << 8) | bytes[i];
  return value;
}

}  // namespace

EventLog::EventLog(const std::string& path) : file_(path, std::ios::binary | std::ios::ate) {
  if (!file_)
    throw ExitError(kExitDataFile, path + " cannot be opened: give the file that lcm-logger wrote");
  size_ = file_.tellg();
  LogEvent first;
  if (!Next(first))
    throw ExitError(kExitDataFile, path + " holds no LCM event: is it a log of lcm-logger?");
  offset_ = events_ = damaged_ = 0;
}

bool EventLog::Next(LogEvent& event) {
  if (offset_ >= size_) return false;
  if (ReadAt(offset_, event)) return true;
  ++damaged_;
  while (SeekSync()) {
    if (ReadAt(offset_, event)) return true;
  }
  return false;
}

// Every length is compared with the file's before anything is allocated.
bool EventLog::ReadAt(std::int64_t offset, LogEvent& event) {
  std::array<std::uint8_t, kHeaderBytes> header;
  file_.clear();
  file_.seekg(offset);
  if (!file_.read(reinterpret_cast<char*>(header.data()), kHeaderBytes)) return false;
  if (BigEndian(header.data(), 4) != kSyncWord) return false;
  const auto channel_bytes = static_cast<std::int64_t>(BigEndian(&header[20], 4));
  const auto data_bytes = static_cast<std::int64_t>(BigEndian(&header[24], 4));
  const std::int64_t end = offset + kHeaderBytes + channel_bytes + data_bytes;
  if (channel_bytes < 1 || channel_bytes > kLongestChannel || end > size_) return false;
  event.utime = static_cast<std::int64_t>(BigEndian(&header[12], 8));
  event.channel.resize(static_cast<std::size_t>(channel_bytes));
  event.bytes.resize(static_cast<std::size_t>(data_bytes));
  file_.read(event.channel.data(), channel_bytes);
  file_.read(reinterpret_cast<char*>(event.bytes.data()), data_bytes);
  if (!file_) return false;
  event.bytes.resize(UntaggedSize(event.bytes.data(), event.bytes.size()));
  offset_ = end;
  ++events_;
  return true;
}

// Moves to the next sync word behind the present offset.
bool EventLog::SeekSync() {
  file_.clear();
  file_.seekg(++offset_);
  std::uint32_t window = 0;
  for (std::int64_t at = offset_; at < size_; ++at) {
    window = (window << 8) | static_cast<std::uint32_t>(file_.get() & 0xff);
    if (window == kSyncWord && at >= offset_ + 3) {
      offset_ = at - 3;
      return true;
    }
  }
  offset_ = size_;
  return false;
}

}  // namespace prospect::services
