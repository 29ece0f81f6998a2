#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "services/common/bus.h"

namespace prospect::services {

/// What the bus carried during a measurement, as a bystander hears it: bytes by channel,
/// evaluations and batches by MODEL_INFO, time from each request to its answer. Reset() begins
/// anew. Belongs to the bus's thread; the bus must outlive it.
class Traffic {
 public:
  explicit Traffic(Bus& bus);

  void Reset();

  std::int64_t statistics_bytes() const { return statistics_bytes_; }
  std::int64_t statistics_messages() const { return statistics_messages_; }
  std::int64_t request_bytes() const { return request_bytes_; }
  std::int64_t requests() const { return requests_; }
  std::int64_t resent() const { return resent_; }
  std::int64_t busy() const { return busy_; }
  std::int64_t reply_bytes() const { return reply_bytes_; }
  std::int64_t replies() const { return replies_; }
  std::int64_t refusals() const { return refusals_; }

  /// First request to last answer, seconds.
  double seconds() const { return 1e-6 * static_cast<double>(last_us_ - first_us_); }
  /// Request to answer, milliseconds; `share` 0.5 is the median. 0 when nothing was answered.
  double Latency(double share) const;

 private:
  void OnRequest(const expand_request_t& request);
  void OnReply(const expand_reply_t& reply);

  std::int64_t statistics_bytes_ = 0, statistics_messages_ = 0;
  std::int64_t request_bytes_ = 0, requests_ = 0, resent_ = 0;
  std::int64_t reply_bytes_ = 0, replies_ = 0, refusals_ = 0, busy_ = 0;
  std::int64_t first_us_ = 0, last_us_ = 0;
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> open_;  // asked and not answered
  std::vector<double> latencies_ms_;
  std::vector<Subscription> subscriptions_;
};

}  // namespace prospect::services
