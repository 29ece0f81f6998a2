#include "planner/warm_start.h"

#include <algorithm>

namespace prospect::planner {

std::vector<WarmHint> ReadWarmHints(const PathTree& paths, const EvaluationTable& evaluations,
                                    const SharedStatistics& statistics, int action, int plan_depth,
                                    int limit) {
  const PathId top = paths.Find(kRoot, action);
  std::vector<double> score(paths.size(), -1.0);
  std::vector<PathId> below;
  // Children have higher ids: from the last id on, each node knows the best below it.
  for (PathId id = paths.size() - 1; id > kRoot; --id) {
    if (!evaluations.Has(id) || statistics.totals(id).visits == 0) continue;
    if (paths.depth(id) >= plan_depth) score[id] = evaluations.value(id);
    const PathId parent = paths.parent(id);
    const double from_parent = score[id] < 0 ? -1 : score[id] * evaluations.done(id);
    score[parent] = std::max(score[parent], from_parent);
    PathId first = id;
    while (paths.depth(first) > 1) first = paths.parent(first);
    if (first == top && id != top) below.push_back(id);
  }
  std::sort(below.begin(), below.end(), [&statistics](PathId a, PathId b) {
    return std::make_pair(-statistics.totals(a).visits, a) <
           std::make_pair(-statistics.totals(b).visits, b);
  });
  if (static_cast<int>(below.size()) > limit) below.resize(limit);
  std::vector<WarmHint> hints;
  for (const PathId id : below) {
    Path path = paths.PathOf(id);
    path.erase(path.begin());
    const double hint = score[id] < 0 ? -1 : score[id] * evaluations.done(id);
    hints.push_back({std::move(path), hint, statistics.totals(id).visits});
  }
  return hints;
}

}  // namespace prospect::planner
