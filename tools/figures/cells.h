#pragma once

#include <string>
#include <vector>

#include "planner/evaluation.h"
#include "planner/plan.h"
#include "planner/search_parameters.h"
#include "report/strip.h"
#include "tools/figures/task_table.h"

namespace prospect::figures {

/// Cells of a course of action: `states` are the evaluations after each action of `path`.
std::vector<report::Cell> CellsOf(const TaskTable& table, const planner::Path& path,
                                  const std::vector<planner::Evaluation>& states,
                                  const std::vector<sim::Image>& pictures,
                                  const planner::SearchParameters& parameters);

/// Why a future was given up after its last step, `step` of them (1: the first): in words, with the
/// numbers. `last` is the state after that step, `score` the future's.
std::string WhyRejected(planner::Rejection rejection, int step, const planner::Evaluation& last,
                        double score, const planner::SearchParameters& parameters);

}  // namespace prospect::figures
