#pragma once

#include <cstdint>
#include <vector>

#include "lcmtypes/messages.h"

namespace prospect::services {

/// How a server fares, for MODEL_INFO: batch sizes, ages, times, hits. Means are smoothed over
/// about the last 20 batches. One thread.
class ServingStatistics {
 public:
  explicit ServingStatistics(int largest_batch)
      : histogram_(static_cast<std::size_t>(largest_batch), 0) {}

  /// A batch of `rows` evaluations that took `batch_ms` after its paths had waited `queue_age_ms`
  /// on average.
  void NoteBatch(int rows, double batch_ms, double queue_age_ms);
  void NoteHits(std::int64_t paths) { hits_ += paths; }

  double batch_ms() const { return batch_ms_; }
  std::int64_t evaluations() const { return evaluations_; }
  std::int64_t hits() const { return hits_; }

  /// Fills the figures of MODEL_INFO.
  void Fill(model_info_t* info) const;

 private:
  std::vector<std::int64_t>
      histogram_;  // [i]: batches of i + 1 rows; the last also holds larger ones
  double batch_ms_ = 0;
  double queue_age_ms_ = 0;
  std::int64_t evaluations_ = 0;
  std::int64_t hits_ = 0;
  std::int64_t batches_ = 0;
};

}  // namespace prospect::services
