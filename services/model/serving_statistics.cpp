#include "services/model/serving_statistics.h"

#include <algorithm>

namespace prospect::services {
namespace {

constexpr double kSmoothing = 0.05;

}  // namespace

void ServingStatistics::NoteBatch(int rows, double batch_ms, double queue_age_ms) {
  if (rows <= 0) return;
  const double weight = std::max(kSmoothing, 1.0 / static_cast<double>(++batches_));
  batch_ms_ += weight * (batch_ms - batch_ms_);
  queue_age_ms_ += weight * (queue_age_ms - queue_age_ms_);
  evaluations_ += rows;
  ++histogram_[std::min(histogram_.size(), static_cast<std::size_t>(rows)) - 1];
}

void ServingStatistics::Fill(model_info_t* info) const {
  info->queue_age_ms = queue_age_ms_;
  info->batch_ms = batch_ms_;
  info->evaluations = evaluations_;
  info->cache_hits = hits_;
  info->batch_histogram = histogram_;
  info->num_bins = static_cast<std::int32_t>(histogram_.size());
}

}  // namespace prospect::services
