#include "services/executive/familiarity_inbox.h"

#include <spdlog/spdlog.h>

#include "services/binding/evaluation_messages.h"
#include "services/binding/novelty_messages.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kTimeoutMs = 3000;
constexpr std::int64_t kRepeatMs = 100;
// Above all request ids of pictures, which are counted from 1.
constexpr std::int64_t kFirstId = std::int64_t{1} << 40;

}  // namespace

FamiliarityInbox::FamiliarityInbox(Conversation& talk) : talk_(talk) {
  subscription_ = talk_.bus().Subscribe<predict_reply_t>(
      [this](const predict_reply_t& reply) { OnReply(reply); });
}

void FamiliarityInbox::OnReply(const predict_reply_t& reply) {
  if (awaited_ == 0 || reply.client_id != talk_.id() || reply.request_id != awaited_) return;
  if (reply.status == expand_reply_t::STATUS_OK) reply_ = reply;
  if (reply.status == expand_reply_t::STATUS_REFUSED) refusal_ = reply.reason;
}

agent::Recognition FamiliarityInbox::Ask(const search_root_t& root) {
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
  agent::Recognition recognition;
  if (!talk_.Until([this] { return reply_.has_value(); }, kTimeoutMs, ask, kRepeatMs)) {
    recognition.defect =
        "no server answered within 3 s" + (refusal_.empty() ? "" : ": " + refusal_);
  } else if (reply_->novelty.empty()) {
    spdlog::warn("nothing is refused for its picture: the weights hold nothing of known ones");
  } else {
    recognition.novelty = FromMessage(reply_->novelty.front());
    if (reply_->width > 0) recognition.redrawn = {reply_->width, reply_->height, reply_->data};
  }
  return recognition;
}

}  // namespace prospect::services
