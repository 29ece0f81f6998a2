#include "services/model/serving_statistics.h"

#include <algorithm>

namespace prospect::services {
namespace {

constexpr double kSmoothing = 0.05;
constexpr double kFirstEdgeMs = 0.125;

}  // namespace

ServingStatistics::ServingStatistics(int largest_batch)
    : histogram_(static_cast<std::size_t>(largest_batch), 0),
      ages_(kTimeBins, 0),
      latencies_(kTimeBins, 0) {}

std::size_t ServingStatistics::TimeBin(double ms) {
  std::size_t bin = 0;
  for (double edge = kFirstEdgeMs; ms >= edge && bin + 1 < kTimeBins; edge *= 2) ++bin;
  return bin;
}

void ServingStatistics::NoteBatch(int rows, double batch_ms, const std::vector<double>& ages_ms) {
  double age_sum = 0;
  for (const double age : ages_ms) ++ages_[TimeBin(age)], age_sum += age;
  if (rows <= 0) return;
  compute_seconds_ += batch_ms / 1000;
  const double queue_age_ms = ages_ms.empty() ? 0 : age_sum / static_cast<double>(ages_ms.size());
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
  info->batches = batches_;
  info->compute_seconds = compute_seconds_;
  info->age_histogram = ages_;
  info->latency_histogram = latencies_;
  info->num_time_bins = static_cast<std::int32_t>(kTimeBins);
  info->num_bins = static_cast<std::int32_t>(histogram_.size());
}

}  // namespace prospect::services
