#pragma once

#include <cstdint>
#include <string>

#include "report/futures_sheet.h"
#include "services/executive/conversation.h"

namespace prospect::services {

struct PredictOptions {
  /// Names of actions in TASK's table one after another, such as "G3,G6": their pictures. Empty:
  /// the action under way, and after it each that may follow.
  std::string actions;
  /// Seconds to wait for what really comes; 0: not at all.
  double truth_seconds = 0;
  /// Wait until the action under way has just begun, so that it is seen from its beginning.
  bool from_start = false;
  /// Of the simulated scene to look at; negative: whichever is there.
  std::int64_t seed = -1;
  /// Begin at this action of the episode (0: the first) or a later one.
  int segment = 0;
  int services_timeout_ms = 15000;
  int picture_timeout_ms = 60000;
};

/// Looks at what the bus shows, asks a model server what comes next, and, if asked to, waits for
/// what really comes. Throws ExitError: kExitServiceLost, kExitWeights, kExitTimeout, kExitUsage on
/// actions that TASK does not have or allow.
report::FuturesSheet Predict(Conversation& talk, const PredictOptions& options);

}  // namespace prospect::services
