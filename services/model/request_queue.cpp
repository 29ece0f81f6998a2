#include "services/model/request_queue.h"

#include <algorithm>
#include <limits>

#include "services/binding/evaluation_messages.h"

namespace prospect::services {

bool RequestQueue::Put(const expand_request_t& request, std::int64_t now_us) {
  const bool waits = std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.client_id == request.client_id && entry.request_id == request.request_id;
  });
  if (waits) return true;
  if (paths_ + request.paths.size() > limit_) return false;
  const std::int64_t expires_us = request.budget_ms < 0 ? std::numeric_limits<std::int64_t>::max()
                                                        : now_us + 1000 * request.budget_ms;
  entries_.push_back({request.client_id, request.request_id, request.search_id, request.epoch,
                      now_us, expires_us, FromMessages(request.paths)});
  paths_ += request.paths.size();
  return true;
}

void RequestQueue::Cancel(std::int64_t search_id, std::int32_t epoch) {
  const auto stale = [&](const Entry& entry) {
    return entry.search_id == search_id && entry.epoch < epoch;
  };
  std::erase_if(entries_, stale);
  Recount();
}

void RequestQueue::Expire(std::int64_t now_us) {
  const auto expired = [&](const Entry& entry) { return entry.expires_us < now_us; };
  std::erase_if(entries_, expired);
  Recount();
}

void RequestQueue::Recount() {
  paths_ = 0;
  for (const Entry& entry : entries_) paths_ += entry.paths.size();
}

}  // namespace prospect::services
