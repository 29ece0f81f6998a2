#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "lcmtypes/messages.h"
#include "planner/path.h"

namespace prospect::services {

/// The model servers that are alive, by their MODEL_INFO, and which of them a path is sent to.
/// Paths with the same first action go to the same server, because it holds the hidden states on
/// the way; when a server does not answer, the next one is asked. Time is an argument (milliseconds
/// of any steady clock). One thread.
class ServerList {
 public:
  /// Silence after which a server is not asked any more, milliseconds; as for HEALTH.
  static constexpr std::int64_t kSilentMs = 3000;

  void Hear(const model_info_t& info, std::int64_t now_ms);

  /// Latest word of each live server with these weights (0: any), by server id.
  std::vector<model_info_t> Live(std::int64_t weights_hash, std::int64_t now_ms) const;

  /// Whom to ask for `path` at the given attempt (0: first); 0, that is any, when nobody is known
  /// to live.
  std::int64_t Choose(const planner::Path& path, int attempt, std::int64_t weights_hash,
                      std::int64_t now_ms) const;

 private:
  struct Entry {
    model_info_t info;
    std::int64_t heard_ms;
  };
  std::map<std::int64_t, Entry> servers_;
};

}  // namespace prospect::services
