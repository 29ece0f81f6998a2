#pragma once

#include <lcm/eventlog.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "lcmtypes/checked_codec.h"
#include "services/common/channels.h"

namespace prospect::services {

/// Writes a log with LCM's own writer, the one that lcm-logger uses.
class LogWriter {
 public:
  explicit LogWriter(const std::string& path) : log_(lcm_eventlog_create(path.c_str(), "w")) {
    if (!log_) throw std::runtime_error("cannot write " + path);
  }
  ~LogWriter() { lcm_eventlog_destroy(log_); }
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  template <class T>
  void Write(T message) {
    messages::SetCounts(message);
    WriteRaw(ChannelOf<T>(), messages::CheckedEncode(message));
  }

  void WriteRaw(std::string channel, std::vector<std::uint8_t> bytes) {
    lcm_eventlog_event_t event{};
    event.timestamp = ++time_;
    event.channellen = static_cast<std::int32_t>(channel.size());
    event.datalen = static_cast<std::int32_t>(bytes.size());
    event.channel = channel.data();
    event.data = bytes.data();
    if (lcm_eventlog_write_event(log_, &event) != 0)
      throw std::runtime_error("cannot write the log");
  }

 private:
  lcm_eventlog_t* log_;
  std::int64_t time_ = 0;
};

}  // namespace prospect::services
