#include "services/supervisor/restart_policy.h"

#include <algorithm>

#include "base/exit_codes.h"

namespace prospect::services {
namespace {

bool IsHopeless(int status) {
  return status == kExitUsage || status == kExitWeights || status == kExitBus ||
         status == kExitBusInUse || status == kExitDisk || status == kExitDataFile ||
         status == 127;  // the program is not there
}

}  // namespace

std::optional<std::int64_t> RestartPolicy::AfterEnd(int status, std::int64_t lived_ms) {
  if (IsHopeless(status)) return std::nullopt;
  if (lived_ms >= kHealthyMs) next_pause_ms_ = 0;
  const std::int64_t pause_ms = next_pause_ms_;
  next_pause_ms_ = std::clamp(2 * pause_ms, kFirstPauseMs, kLongestPauseMs);
  return pause_ms;
}

}  // namespace prospect::services
