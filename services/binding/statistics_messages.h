#pragma once

#include "lcmtypes/messages.h"
#include "planner/statistics_batch.h"

namespace prospect::services {

// SEARCH_STATISTICS between the wire and the planner: field by field, nothing is lost either way,
// so the planner's checksum holds on both sides. Pure functions, safe from any thread.

/// @param lease_ms how long the sender's visits in flight hold without news, milliseconds
search_statistics_t ToMessage(const planner::StatisticsBatch& batch, int lease_ms);
planner::StatisticsBatch FromMessage(const search_statistics_t& message);

}  // namespace prospect::services
