#include "services/console/picture_asker.h"

#include "services/binding/evaluation_messages.h"
#include "services/common/clock.h"
#include "services/console/picture_store.h"

namespace prospect::services::console {
namespace {

constexpr int kMostAttempts = 3;
constexpr std::size_t kMostKnown = 100'000;

}  // namespace

void PictureAsker::Want(const Wish& wish, bool urgent) {
  if (known_.size() >= kMostKnown) known_.clear();
  if (!known_.insert(PictureKey(wish.search_id, wish.path)).second) return;
  if (urgent) return urgent_.push_back(wish);
  waiting_.push_front(wish);
  if (waiting_.size() <= kMostWaiting) return;
  known_.erase(PictureKey(waiting_.back().search_id, waiting_.back().path));
  waiting_.pop_back();
}

void PictureAsker::Hear(const predict_reply_t& reply) {
  if (asked_ && reply.client_id == client_id_ && reply.request_id == request_id_) asked_.reset();
}

void PictureAsker::Turn(std::int64_t now_ms, bool searching,
                        const std::function<bool(const Wish&)>& there) {
  if (asked_ && now_ms - asked_ms_ < kTimeoutMs) return;
  if (searching && now_ms - asked_ms_ < kWhileSearchingMs) return;
  if (asked_ && ++attempt_ >= kMostAttempts) asked_.reset();
  while (!asked_ && !Line()->empty()) {
    const Wish wish = Line()->front();
    Line()->pop_front();
    if (!there(wish)) asked_ = wish, ++request_id_, attempt_ = 0;
    // Dropped from memory later, it may be asked for again.
    if (!asked_) known_.erase(PictureKey(wish.search_id, wish.path));
  }
  if (!asked_) return;
  asked_ms_ = now_ms;
  predict_request_t request{};
  request.utime = UtimeNow();
  request.client_id = client_id_;
  request.request_id = request_id_;
  request.attempt = attempt_;
  request.search_id = asked_->search_id;
  request.epoch = asked_->epoch;
  request.path = ToMessage(asked_->path);
  request.want_image = 1;
  say_(request);
}

}  // namespace prospect::services::console
