#pragma once

#include "agent/record.h"
#include "lcmtypes/messages.h"

namespace prospect::services {

/// PLAN for the latest search of an episode and what became of its plan so far, without utime and
/// ids. The record must have a search. A pure function.
plan_t PlanMessage(const agent::EpisodeRecord& record);

}  // namespace prospect::services
