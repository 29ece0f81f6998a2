#include "services/predict/gesture_watch.h"

#include <algorithm>

namespace prospect::services {

GestureWatch::GestureWatch(Conversation& talk) : talk_(talk) {
  subscription_ = talk_.bus().Subscribe<label_t>([this](const label_t& label) { OnLabel(label); });
}

void GestureWatch::OnLabel(const label_t& label) {
  const std::int64_t followed = talk_.view().episode_id();
  elsewhere_ = followed >= 0 && label.episode_id != followed;
  if (elsewhere_) return;
  if (label.episode_id != episode_id_) {
    episode_id_ = label.episode_id;
    last_frame_ = -1;
    over_ = false;
    segments_.clear();
  }
  last_frame_ = std::max(last_frame_, label.frame);
  over_ = over_ || label.outcome == label_t::OUTCOME_SUCCESS ||
          label.outcome == label_t::OUTCOME_FAILURE;
  if (label.segment < 0) return;
  const auto [found, is_new] = segments_.emplace(
      label.segment, Segment{label.segment, label.action, label.previous_action, label.frame});
  if (!is_new) found->second.frame = std::min(found->second.frame, label.frame);
}

std::optional<GestureWatch::Segment> GestureWatch::Latest() const {
  if (segments_.empty()) return std::nullopt;
  return segments_.rbegin()->second;
}

std::optional<GestureWatch::Segment> GestureWatch::Find(int number) const {
  const auto found = segments_.find(number);
  if (found == segments_.end()) return std::nullopt;
  return found->second;
}

}  // namespace prospect::services
