// Things that happen at points of virtual time, in order; at the same time, in the order in which
// they were planned. Not thread safe.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace prospect::tools {

class EventQueue {
 public:
  using Action = std::function<void()>;

  std::int64_t now_us() const { return now_us_; }
  bool empty() const { return events_.empty(); }
  // At time_us, or now if that has passed.
  void At(std::int64_t time_us, Action action) {
    events_.push({std::max(time_us, now_us_), ++planned_, std::move(action)});
  }
  // Moves the clock to the next event and lets it happen.
  void Next() {
    Event event = std::move(const_cast<Event&>(events_.top()));  // popped at once
    events_.pop();
    now_us_ = event.time_us;
    event.action();
  }

 private:
  struct Event {
    std::int64_t time_us;
    std::uint64_t order;
    Action action;
    bool operator<(const Event& other) const {
      return std::make_pair(other.time_us, other.order) < std::make_pair(time_us, order);
    }
  };
  std::priority_queue<Event> events_;
  std::int64_t now_us_ = 0;
  std::uint64_t planned_ = 0;
};

}  // namespace prospect::tools
