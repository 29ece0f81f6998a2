#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "agent/mind.h"
#include "lcmtypes/messages.h"
#include "services/executive/conversation.h"

namespace prospect::services {

/// Asks the model servers how unlike the known pictures a search's root is. Hears PREDICT_REPLY
/// from its construction on. One thread; the conversation must outlive it.
class FamiliarityInbox {
 public:
  explicit FamiliarityInbox(Conversation& talk);

  /// What a server says of the root of `root`'s search, which must have been encoded
  /// (PREDICT_REQUEST for the empty path, repeated until answered, 3 s at most).
  agent::Recognition Ask(const search_root_t& root);

 private:
  void OnReply(const predict_reply_t& reply);

  Conversation& talk_;
  std::int64_t awaited_ = 0;  // request id; 0: none
  std::optional<predict_reply_t> reply_;
  std::string refusal_;  // by which a server last refused to answer; another one may not
  Subscription subscription_;
};

}  // namespace prospect::services
