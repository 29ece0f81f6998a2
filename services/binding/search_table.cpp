#include "services/binding/search_table.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <vector>

#include "base/hash.h"

namespace prospect::services {
namespace {

using planner::Path;

std::string Line(const planner::Search& search, const Path& path) {
  const planner::PathId id = search.paths().Find(path);
  const auto& totals = search.statistics().totals(id);
  char text[160];
  std::snprintf(text, sizeof text, " N %" PRId64 " W %" PRId64 " best %a", totals.visits,
                totals.value_sum, static_cast<double>(totals.best));
  std::string line = planner::ToString(path) + text;
  const auto& evaluations = search.evaluation_table();
  if (!evaluations.Has(id)) return line + " unknown\n";
  const planner::Evaluation evaluation = evaluations.Get(id);
  std::snprintf(text, sizeof text, " by %016" PRIx64 " V %a f %a", evaluations.fingerprint(id),
                static_cast<double>(evaluation.value), static_cast<double>(evaluation.done));
  line += text;
  for (const auto* numbers : {&evaluation.q, &evaluation.p}) {
    for (const float number : *numbers) {
      std::snprintf(text, sizeof text, " %a", static_cast<double>(number));
      line += text;
    }
  }
  return line + "\n";
}

}  // namespace

std::string TableText(const planner::Search& search) {
  std::vector<Path> visited;
  for (planner::PathId id = planner::kRoot; id < search.paths().size(); ++id) {
    if (search.statistics().totals(id).visits > 0) visited.push_back(search.paths().PathOf(id));
  }
  std::sort(visited.begin(), visited.end());
  std::string text;
  for (const Path& path : visited) text += Line(search, path);
  return text;
}

std::uint64_t TableHash(const planner::Search& search) { return base::HashText(TableText(search)); }

}  // namespace prospect::services
