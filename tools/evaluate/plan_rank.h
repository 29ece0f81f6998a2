#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "model/dataset.h"
#include "model/engine.h"
#include "planner/task_rules.h"

namespace prospect::tools {

/// Where what a recorded trial carried out stands, by its score, among what the rules would have
/// allowed in its scene.
struct PlanRank {
  bool succeeded = false;
  int others = 0;    ///< legal paths of the same length that it was compared with, at least 1
  double above = 0;  ///< share of them that score less; equal ones count half
};

/// Of each of these trials the path that was carried out, to its end or to where it failed, among
/// at most `most` others, drawn by the trial's number. A trial that the rules do not allow (begun
/// anew, say) or whose scene allows nothing else is left out. `progress` is called after each.
/// Throws DataError, and WeightsError where the engine was made for another table.
std::vector<PlanRank> RankPlans(model::Engine& engine, const model::TrialFile& file,
                                const std::vector<std::size_t>& trials,
                                const planner::TaskRules& rules, int most,
                                const std::function<void()>& progress = nullptr);

/// Keys: `succeeded` and `failed`, each {trials, above: mean}, and `others`: mean number.
nlohmann::json ReportOf(const std::vector<PlanRank>& ranks);

/// Of such a report, for people.
std::string RankWords(const nlohmann::json& report);

}  // namespace prospect::tools
