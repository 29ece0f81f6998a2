#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace prospect::services::console {

/// What goes over the bus, a row a channel: messages, bytes, what was refused and why, and rates
/// over the last second or more. Bounded: what more than kMostChannels say counts as one. Times are
/// microseconds of the messages' clock. One thread at a time.
class Traffic {
 public:
  static constexpr std::size_t kMostChannels = 64;

  /// @param refused why the message is not believed; empty: it is
  void Add(const std::string& channel, std::size_t bytes, const std::string& refused,
           std::int64_t now_us);

  /// Rows {name, messages, bytes, per_second, bytes_per_second, refused: {reason: count}}.
  nlohmann::json ToJson(std::int64_t now_us);

 private:
  struct Row {
    std::int64_t messages = 0, bytes = 0;
    std::int64_t messages_then = 0, bytes_then = 0;
    double per_second = 0, bytes_per_second = 0;
    std::map<std::string, std::int64_t> refused;
  };

  void TakeRates(std::int64_t now_us);

  std::map<std::string, Row> rows_;
  std::int64_t since_us_ = 0;
};

}  // namespace prospect::services::console
