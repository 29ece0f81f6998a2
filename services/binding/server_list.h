#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "lcmtypes/messages.h"
#include "planner/path.h"
#include "services/binding/server_conduct.h"

namespace prospect::services {

/// The model servers that are alive, by their MODEL_INFO, and which of them a path is sent to.
/// Paths that begin with the same actions go to the same server, because it holds the hidden states
/// on the way: how many actions is the prefix length, the shortest that leaves several live
/// subtrees a server. Servers are ranked for a prefix by hash (rendezvous hashing, Thaler and
/// Ravishankar 1998), so that a server that comes or goes moves only its own paths. The first in
/// rank is asked unless it is a suspect, or says that paths wait with it for more than a batch and
/// another's wait is shorter by that; when it does not answer, the next is asked. Time is an
/// argument (milliseconds of any steady clock). One thread.
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
                      std::int64_t now_ms, const ServerConduct& conduct = {}) const;

  /// Subtrees a server that a prefix length should leave.
  static constexpr int kSubtreesEach = 4;
  /// Actions that decide, at least 1.
  void SetPrefixLength(int actions) { prefix_length_ = actions; }
  int prefix_length() const { return prefix_length_; }

 private:
  struct Entry {
    model_info_t info;
    std::int64_t heard_ms;
  };
  std::map<std::int64_t, Entry> servers_;
  int prefix_length_ = 1;
};

}  // namespace prospect::services
