#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "services/executive/conversation.h"

namespace prospect::services {

/// What LABEL says of the episode that is followed (of any, while none is): when each action began,
/// and what it was. Hears from its construction on. One thread; the conversation must outlive it.
class GestureWatch {
 public:
  /// An action under way or over.
  struct Segment {
    int number = -1;
    int action = 0;
    int previous = 0;        ///< the action before it; the table's size: none
    std::int64_t frame = 0;  ///< the first frame of it that was heard of
  };

  explicit GestureWatch(Conversation& talk);

  /// The latest segment that has begun; nothing before the first.
  std::optional<Segment> Latest() const;
  /// Segment `number`, if its beginning was heard.
  std::optional<Segment> Find(int number) const;
  /// The latest label was of another episode than the one that is followed.
  bool elsewhere() const { return elsewhere_; }
  bool heard_any() const { return last_frame_ >= 0; }
  /// The trial is over: no further segment comes.
  bool over() const { return over_; }
  std::int64_t last_frame() const { return last_frame_; }

 private:
  void OnLabel(const label_t& label);

  Conversation& talk_;
  std::int64_t episode_id_ = -1;
  std::int64_t last_frame_ = -1;
  bool over_ = false, elsewhere_ = false;
  std::map<int, Segment> segments_;
  Subscription subscription_;
};

}  // namespace prospect::services
