#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "lcmtypes/messages.h"
#include "planner/path.h"

namespace prospect::services {

/// EXPAND_REQUESTs that wait, oldest first. A repeat of one that waits already is dropped, so that
/// impatient clients do not fill the queue. One thread; time is an argument (microseconds of any
/// steady clock).
class RequestQueue {
 public:
  struct Entry {
    std::int64_t client_id;
    std::int64_t request_id;
    std::int64_t search_id;
    std::int32_t epoch;
    std::int64_t arrived_us;
    std::int64_t expires_us;  // after that its client no longer wants the answer
    std::vector<planner::Path> paths;
  };

  /// @param limit most paths that may wait
  explicit RequestQueue(std::size_t limit) : limit_(limit) {}

  /// False, with nothing taken, when the queue is full.
  bool Put(const expand_request_t& request, std::int64_t now_us);

  /// Forgets the requests of a search (all epochs below `epoch`).
  void Cancel(std::int64_t search_id, std::int32_t epoch);
  /// Forgets what has expired.
  void Expire(std::int64_t now_us);

  bool empty() const { return entries_.empty(); }
  std::size_t paths() const { return paths_; }
  std::deque<Entry>& entries() { return entries_; }
  /// Call after removing or shortening entries.
  void Recount();

 private:
  std::size_t limit_;
  std::size_t paths_ = 0;
  std::deque<Entry> entries_;
};

}  // namespace prospect::services
