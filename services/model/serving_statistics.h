#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lcmtypes/messages.h"

namespace prospect::services {

/// How a server fares, for MODEL_INFO: batch sizes, ages, times, hits. Means are smoothed over
/// about the last 20 batches. One thread.
class ServingStatistics {
 public:
  explicit ServingStatistics(int largest_batch);

  /// Bins of the histograms of times: bin i counts those below 0.125 ms x 2^i, the last the rest.
  static constexpr std::size_t kTimeBins = 16;
  static std::size_t TimeBin(double ms);

  /// A batch of `rows` evaluations that took `batch_ms`; how long each of its paths had waited.
  void NoteBatch(int rows, double batch_ms, const std::vector<double>& ages_ms);
  /// A request was answered in full, so long after it arrived.
  void NoteAnswer(double latency_ms) { ++latencies_[TimeBin(latency_ms)]; }
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
  double compute_seconds_ = 0;
  std::vector<std::int64_t> ages_, latencies_;  // histograms by TimeBin
};

}  // namespace prospect::services
