#include "services/executive/predictions.h"

#include <spdlog/spdlog.h>

#include "services/binding/evaluation_messages.h"
#include "services/binding/task_messages.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kTimeoutMs = 3000;
constexpr std::int64_t kEachMs = 50;
constexpr std::int64_t kRepeatMs = 250;

}  // namespace

PredictionInbox::PredictionInbox(Conversation& talk) : talk_(talk) {
  subscription_ = talk_.bus().Subscribe<predict_reply_t>(
      [this](const predict_reply_t& reply) { OnReply(reply); });
}

void PredictionInbox::OnReply(const predict_reply_t& reply) {
  const auto awaited = awaited_.find(reply.request_id);
  if (reply.client_id != talk_.id() || awaited == awaited_.end()) return;
  if (reply.status == expand_reply_t::STATUS_REFUSED) refusal_ = reply.reason;
  if (reply.status != expand_reply_t::STATUS_OK || reply.width == 0) return;
  pictures_[awaited->second] = {reply.width, reply.height, reply.data};
  awaited_.erase(awaited);
}

std::map<planner::Path, agent::Picture> PredictionInbox::Fetch(
    const search_root_t& root, const std::vector<planner::Path>& paths) {
  awaited_.clear();
  pictures_.clear();
  refusal_.clear();
  for (const auto& path : paths) awaited_[next_id_++] = path;
  std::int32_t attempt = 0;
  const auto ask = [&] {
    for (const auto& [id, path] : awaited_) {
      predict_request_t request{};
      request.client_id = talk_.id();
      request.request_id = id;
      request.attempt = attempt;
      request.server_id =
          talk_.view().servers().Choose(path, attempt, root.weights_hash, SteadyMs());
      request.search_id = root.search_id;
      request.epoch = root.epoch;
      request.path = ToMessage(path);
      request.want_image = 1;
      talk_.Say(request);
    }
    ++attempt;
  };
  const std::int64_t timeout_ms = kTimeoutMs + kEachMs * static_cast<std::int64_t>(paths.size());
  if (!talk_.Until([this] { return awaited_.empty(); }, timeout_ms, ask, kRepeatMs)) {
    spdlog::warn("{} of {} predicted pictures did not come, the first that of {}{}",
                 awaited_.size(), paths.size(),
                 NamesOf(*talk_.view().task(), awaited_.begin()->second),
                 refusal_.empty() ? "" : ": " + refusal_);
  }
  return pictures_;
}

}  // namespace prospect::services
