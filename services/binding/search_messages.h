#pragma once

#include "lcmtypes/messages.h"
#include "planner/path.h"
#include "planner/search_parameters.h"
#include "planner/statistics_batch.h"

namespace prospect::services {

// SEARCH_ROOT between the wire and the planner. Pure functions, safe from any thread.

/// Fills rule, named parameters, depth, samples and seed of `root` from `parameters`. The deadline
/// is budget_ms, which the publisher sets itself at each repeat.
void SetParameters(const planner::SearchParameters& parameters, search_root_t* root);

/// The planner's parameters. Names this version does not know are ignored; the deadline is
/// budget_ms from `now_us`.
planner::SearchParameters ParametersFrom(const search_root_t& root, std::int64_t now_us);

planner::SearchId SearchIdFrom(const search_root_t& root);
planner::Path ExecutedFrom(const search_root_t& root);

/// A name in `names` with its number, or `otherwise`.
double ParameterOr(const search_root_t& root, const char* name, double otherwise);

}  // namespace prospect::services
