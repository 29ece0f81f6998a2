#include "services/binding/statistics_messages.h"

#include "planner/statistics_codec.h"

namespace prospect::services {
namespace {

std::int64_t Wire(std::uint64_t value) { return static_cast<std::int64_t>(value); }
std::uint64_t Library(std::int64_t value) { return static_cast<std::uint64_t>(value); }

}  // namespace

search_statistics_t ToMessage(const planner::StatisticsBatch& batch, int lease_ms) {
  search_statistics_t message{};
  message.search_id = Wire(batch.search.id);
  message.epoch = static_cast<std::int32_t>(batch.search.epoch);
  message.writer = Wire(batch.writer);
  message.sequence = Wire(batch.sequence);
  message.lease_ms = lease_ms;
  message.rollouts = batch.totals.rollouts;
  message.evaluations = batch.totals.evaluations;
  message.in_flight = static_cast<std::int32_t>(batch.totals.in_flight);
  message.row_count = static_cast<std::int32_t>(batch.totals.rows);
  message.digest = Wire(batch.totals.digest);
  message.is_final = batch.totals.finished ? 1 : 0;
  message.checksum = Wire(batch.checksum);
  message.claimed = static_cast<std::int32_t>(batch.totals.claimed);
  message.round = static_cast<std::int32_t>(batch.totals.round);
  message.rows = planner::PackRows(batch);
  message.num_bytes = static_cast<std::int32_t>(message.rows.size());
  return message;
}

planner::StatisticsBatch FromMessage(const search_statistics_t& message) {
  planner::StatisticsBatch batch;
  batch.search = {Library(message.search_id), static_cast<std::uint32_t>(message.epoch)};
  batch.writer = Library(message.writer);
  batch.sequence = Library(message.sequence);
  batch.totals.rollouts = message.rollouts;
  batch.totals.evaluations = message.evaluations;
  batch.totals.in_flight = message.in_flight;
  batch.totals.rows = message.row_count;
  batch.totals.digest = Library(message.digest);
  batch.totals.finished = message.is_final != 0;
  batch.checksum = Library(message.checksum);
  batch.totals.claimed = message.claimed;
  batch.totals.round = message.round;
  // Bytes that are no rows leave none, and the checksum tells the planner.
  static_cast<void>(planner::UnpackRows(message.rows, &batch));
  return batch;
}

}  // namespace prospect::services
