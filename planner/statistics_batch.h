// What workers send each other about a search: rows of the shared table. These structs are what a
// SEARCH_STATISTICS message carries, field by field; planner/shared_statistics.h makes and merges
// them. Plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/path.h"

namespace prospect::planner {

// One search: what else is on the bus belongs to other searches, or to an earlier epoch of this
// one.
struct SearchId {
  std::uint64_t id = 0;
  std::uint32_t epoch = 0;
};
inline bool operator==(const SearchId& a, const SearchId& b) {
  return a.id == b.id && a.epoch == b.epoch;
}
inline bool operator!=(const SearchId& a, const SearchId& b) { return !(a == b); }

// Values are whole multiples of 1 / kValueOne, so that sums do not depend on the order of adding,
// and a single visit's sum is its value. A millionth is far below what networks can tell apart, and
// keeps rows short on the wire.
constexpr std::int64_t kValueOne = std::int64_t{1} << 20;

// What one writer knows from its own rollouts about one path. Only the writer changes its row.
struct StatisticsRow {
  std::uint64_t writer = 0;  // whose row it is (not necessarily the sender), never 0
  Path path;                 // which node
  // When the writer said so: the sequence number of its batch; 0 in a relayed row. Not on the wire:
  // N orders what is permanent, and the batch's own number what is not (O).
  std::uint64_t version = 0;
  std::int64_t visits = 0;     // N: completed visits; only grows
  std::int64_t value_sum = 0;  // W: sum of backed-up values, 0 <= W <= N kValueOne
  float best = 0;  // v*: highest backed-up value, a multiple of 1 / kValueOne, [0, 1]; 0 if N = 0
  std::int32_t in_flight = 0;  // O: visits begun and not yet completed, >= 0; 0 in a relayed row
};

// The sender's own account of itself, so that receivers know what they miss.
struct WriterTotals {
  std::int64_t rollouts = 0;     // completed by the sender
  std::int64_t evaluations = 0;  // paths the sender had evaluated at its own request
  std::int64_t in_flight = 0;    // rollouts of the sender that wait for an evaluation
  std::int64_t rows = 0;         // own rows with N > 0
  std::uint64_t digest = 0;      // over own rows with N > 0: path, N, W, v*; independent of order
  bool finished = false;         // the sender starts no more rollouts and has none in flight
  std::int64_t claimed = 0;      // rollouts the sender may begin in all: planner/rollout_claims.h
  std::int64_t round = 0;        // how often the sender has renewed its claim
};

struct StatisticsBatch {
  SearchId search;
  std::uint64_t writer = 0;    // the sender
  std::uint64_t sequence = 0;  // 1, 2, ... for each batch the sender makes in this search
  WriterTotals totals;
  std::vector<StatisticsRow> rows;  // own rows, and relayed rows of others
  std::uint64_t checksum = 0;       // PayloadChecksum of all of the above
};

// Over every field but `checksum`. The same number on every machine.
std::uint64_t PayloadChecksum(const StatisticsBatch& batch);

// Bytes of a SEARCH_STATISTICS message without rows, and of a row in it at a usual place (see
// planner/statistics_codec.h): what byte budgets are counted in.
constexpr std::size_t kBatchHeaderBytes = 105;
std::size_t RowBytes(const StatisticsRow& row, bool relayed);

}  // namespace prospect::planner
