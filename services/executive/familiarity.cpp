#include "services/executive/familiarity.h"

#include <spdlog/spdlog.h>

#include <cstdio>

#include "services/binding/evaluation_messages.h"
#include "services/binding/novelty_messages.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kTimeoutMs = 3000;
constexpr std::int64_t kRepeatMs = 100;
// Above all request ids of pictures, which are counted from 1.
constexpr std::int64_t kFirstId = std::int64_t{1} << 40;

}  // namespace

std::string FamiliaritySentence(const Familiarity& familiarity) {
  if (familiarity.foreign())
    return "It is unlike what the networks were trained on: " +
           model::InWords(familiarity.novelty) + ".";
  char text[64];
  std::snprintf(text, sizeof text, "The picture is like known ones (p %.2g).",
                familiarity.novelty.p);
  return text;
}

FamiliarityInbox::FamiliarityInbox(Conversation& talk) : talk_(talk) {
  subscription_ = talk_.bus().Subscribe<predict_reply_t>(
      [this](const predict_reply_t& reply) { OnReply(reply); });
}

void FamiliarityInbox::OnReply(const predict_reply_t& reply) {
  if (awaited_ == 0 || reply.client_id != talk_.id() || reply.request_id != awaited_) return;
  if (reply.status == expand_reply_t::STATUS_OK) reply_ = reply;
  if (reply.status == expand_reply_t::STATUS_REFUSED) refusal_ = reply.reason;
}

Recognition FamiliarityInbox::Ask(const search_root_t& root, const Picture& seen, double level) {
  reply_.reset();
  refusal_.clear();
  awaited_ = awaited_ == 0 ? kFirstId : awaited_ + 1;
  std::int32_t attempt = 0;
  const auto ask = [&] {
    predict_request_t request{};
    request.client_id = talk_.id();
    request.request_id = awaited_;
    request.attempt = attempt;
    request.server_id = talk_.view().servers().Choose({}, attempt++, root.weights_hash, SteadyMs());
    request.search_id = root.search_id;
    request.epoch = root.epoch;
    request.path = ToMessage(planner::Path{});
    request.want_image = 1;
    talk_.Say(request);
  };
  if (!talk_.Until([this] { return reply_.has_value(); }, kTimeoutMs, ask, kRepeatMs))
    return {{}, "no server answered within 3 s" + (refusal_.empty() ? "" : ": " + refusal_)};
  if (reply_->reason.empty()) {
    spdlog::warn("nothing is refused for its picture: the weights hold nothing of known ones");
    return {};
  }
  const auto novelty = NoveltyFrom(reply_->reason);
  if (!novelty) return {{}, "a server's answer cannot be read: " + reply_->reason};
  Familiarity familiarity;
  familiarity.novelty = *novelty;
  familiarity.level = level;
  familiarity.seen = seen;
  if (reply_->width > 0) familiarity.redrawn = {reply_->width, reply_->height, reply_->data};
  return {familiarity, ""};
}

}  // namespace prospect::services
