#include "services/bench/traffic.h"

#include <algorithm>

#include "services/common/clock.h"

namespace prospect::services {
Traffic::Traffic(Bus& bus) {
  subscriptions_.push_back(
      bus.Subscribe<search_statistics_t>([this](const search_statistics_t& statistics) {
        statistics_bytes_ += statistics.getEncodedSize();
        ++statistics_messages_;
      }));
  subscriptions_.push_back(bus.Subscribe<expand_request_t>(
      [this](const expand_request_t& request) { OnRequest(request); }));
  subscriptions_.push_back(
      bus.Subscribe<expand_reply_t>([this](const expand_reply_t& reply) { OnReply(reply); }));
}

void Traffic::Reset() {
  statistics_bytes_ = statistics_messages_ = request_bytes_ = requests_ = resent_ = 0;
  reply_bytes_ = replies_ = refusals_ = busy_ = first_us_ = last_us_ = 0;
  open_.clear();
  latencies_ms_.clear();
}

void Traffic::OnRequest(const expand_request_t& request) {
  const std::int64_t now_us = SteadyUs();
  if (first_us_ == 0) first_us_ = last_us_ = now_us;
  request_bytes_ += request.getEncodedSize();
  ++requests_;
  if (request.attempt > 0) ++resent_;
  // When it was sent, by the client's wall clock, which is this host's: so both ways are counted.
  open_.emplace(std::make_pair(request.client_id, request.request_id), request.utime);
}

void Traffic::OnReply(const expand_reply_t& reply) {
  const std::int64_t now_us = SteadyUs();
  reply_bytes_ += reply.getEncodedSize();
  ++replies_;
  if (reply.status == expand_reply_t::STATUS_BUSY) ++busy_;
  if (reply.status != expand_reply_t::STATUS_OK) {
    ++refusals_;
    return;
  }
  last_us_ = now_us;
  const std::int64_t now_utime = UtimeNow();
  for (std::size_t i = 0; i < reply.request_ids.size(); ++i) {
    const auto asked = open_.find({reply.client_ids[i], reply.request_ids[i]});
    if (asked == open_.end()) continue;
    latencies_ms_.push_back(1e-3 * static_cast<double>(now_utime - asked->second));
    open_.erase(asked);
  }
}

double Traffic::Latency(double share) const {
  if (latencies_ms_.empty()) return 0;
  std::vector<double> sorted = latencies_ms_;
  std::sort(sorted.begin(), sorted.end());
  const auto at = static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5);
  return sorted[at];
}

}  // namespace prospect::services
