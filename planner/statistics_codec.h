// The rows of a batch as bytes: what SEARCH_STATISTICS carries. A row takes 5 to 12 bytes, because
// its path is said by what it shares with the row before, and numbers are as long as they are great
// (varint: 7 bits a byte, low bits first, the high bit says that more follow).
//
//   table   varint number of other writers, then 8 bytes (low first) for each
//   row     1 byte: bit 7 a writer follows; bit 6 O follows; bit 5 the suffix is one action;
//             bits 0-4 how many actions the path shares with the row before (none at the first
//             row), 31 where it shares more
//           varint writer's place in the table, counted from 1, 0 for the sender (if bit 7; if not:
//             as in the row before, at first the sender)
//           varint suffix length (if not bit 5), then the suffix's actions, a byte each
//           varint N, varint W (if N > 0), varint v* in units of 1 / kValueOne (if N > 1; else W),
//           varint O (if bit 6)
//
// Pure functions; safe from any thread. The decoder trusts nothing: it allocates at most in
// proportion to the bytes it is given.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/statistics_batch.h"

namespace prospect::planner {

// Rows as they stand; shortest if sorted by (writer, path). v* must be a multiple of 1 / kValueOne
// (rounded otherwise), N, W and O not negative, and v* = W where N = 1.
std::vector<std::uint8_t> PackRows(const StatisticsBatch& batch);

// Reads into batch->rows, and sets each row's version (batch->sequence for the sender's own rows,
// 0 for relayed ones); batch->writer and batch->sequence must be set. False, and no rows, if the
// bytes are not rows: cut short, numbers beyond their type, paths longer than kMaxPathLength, v*
// above 1. Whether rows make sense is for SharedStatistics::Merge to judge.
[[nodiscard]] bool UnpackRows(std::span<const std::uint8_t> bytes, StatisticsBatch* batch);

}  // namespace prospect::planner
