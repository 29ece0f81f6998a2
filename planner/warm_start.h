// What a search may take over from the one before it, when one of its actions was carried out:
// hints for Q, and which futures to have evaluated first. Never counts, never evaluations: the
// scene was looked at again, and what is imagined from the new picture is another thing. Plain
// value.
#pragma once

#include <vector>

#include "planner/evaluation_table.h"
#include "planner/search_parameters.h"
#include "planner/shared_statistics.h"
#include "planner/task_rules.h"

namespace prospect::planner {

struct WarmHint {
  Path path;         // from the new root
  double score = 0;  // best score of a complete future through it, counted from it on: V f ...
  std::int64_t visits = 0;  // N it had: only to order by
};

// The futures below `action` of a former search, most visited first, at most `limit`; score is
// below 0 where no complete future was known. A parent stands before its children.
std::vector<WarmHint> ReadWarmHints(const PathTree& paths, const EvaluationTable& evaluations,
                                    const SharedStatistics& statistics, int action, int plan_depth,
                                    int limit);

}  // namespace prospect::planner
