#pragma once

#include <cstdint>
#include <optional>

namespace prospect::services {

/// When a service that ended by itself is started again: at once the first time, then after pauses
/// that double up to half a minute; one that lived for half a minute begins anew. Not at all after
/// an error that another start cannot mend (options, weights, bus, disk, data: exit_codes.h).
class RestartPolicy {
 public:
  static constexpr std::int64_t kFirstPauseMs = 500;
  static constexpr std::int64_t kLongestPauseMs = 30000;
  static constexpr std::int64_t kHealthyMs = 30000;

  /// It ended with exit status `status` (128 + signal when killed) after `lived_ms`.
  /// @return milliseconds until the next start; nothing: never again
  std::optional<std::int64_t> AfterEnd(int status, std::int64_t lived_ms);

 private:
  std::int64_t next_pause_ms_ = 0;
};

}  // namespace prospect::services
