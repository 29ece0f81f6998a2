#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lcmtypes/messages.h"
#include "model/novelty_words.h"
#include "services/executive/conversation.h"
#include "services/executive/picture.h"

namespace prospect::services {

/// Whether the picture an episode began with is one that the networks know how to read.
struct Familiarity {
  model::Novelty novelty;
  double level = model::kNoveltyLevel;  ///< pictures with a smaller p are refused
  Picture seen;                         ///< what was judged
  Picture redrawn;                      ///< what the networks make of it; empty: did not come

  bool foreign() const { return novelty.p < level; }
};

/// One sentence for a person: "The picture is like known ones (p 0.43).", or what is unusual about
/// it.
std::string FamiliaritySentence(const Familiarity& familiarity);

/// What the model servers answered.
struct Recognition {
  /// None: the weights hold nothing of known pictures, so that there is nothing to compare with; or
  /// nobody could be asked.
  std::optional<Familiarity> familiarity;
  /// Why nobody could be asked: "no server answered within 3 s". Empty: somebody was.
  std::string defect;
};

/// Asks the model servers how unlike the known pictures a search's root is. Hears PREDICT_REPLY
/// from its construction on. One thread; the conversation must outlive it.
class FamiliarityInbox {
 public:
  explicit FamiliarityInbox(Conversation& talk);

  /// What a server says of the root of `root`'s search, which must have been encoded
  /// (PREDICT_REQUEST for the empty path, repeated until answered, 3 s at most).
  Recognition Ask(const search_root_t& root, const Picture& seen, double level);

 private:
  void OnReply(const predict_reply_t& reply);

  Conversation& talk_;
  std::int64_t awaited_ = 0;  // request id; 0: none
  std::optional<predict_reply_t> reply_;
  std::string refusal_;  // by which a server last refused to answer; another one may not
  Subscription subscription_;
};

}  // namespace prospect::services
