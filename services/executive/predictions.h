#pragma once

#include <map>
#include <string>
#include <vector>

#include "agent/picture.h"
#include "lcmtypes/messages.h"
#include "planner/path.h"
#include "services/executive/conversation.h"

namespace prospect::services {

/// Asks the model servers for pictures of imagined states. Hears PREDICT_REPLY from its
/// construction on. One thread; the conversation must outlive it.
class PredictionInbox {
 public:
  explicit PredictionInbox(Conversation& talk);

  /// What the world would look like after each of `paths` from the root of `root`'s search
  /// (PREDICT_REQUEST, repeated until answered). A picture that does not come within 3 s, and 50 ms
  /// more for each picture, is missing from the map.
  std::map<planner::Path, agent::Picture> Fetch(const search_root_t& root,
                                                const std::vector<planner::Path>& paths);

 private:
  void OnReply(const predict_reply_t& reply);

  Conversation& talk_;
  std::map<std::int64_t, planner::Path> awaited_;  // by request id
  std::map<planner::Path, agent::Picture> pictures_;
  std::string refusal_;  // by which a server last refused to draw; another one may not
  std::int64_t next_id_ = 1;
  Subscription subscription_;
};

}  // namespace prospect::services
