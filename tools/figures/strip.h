#pragma once

#include <string>
#include <vector>

#include "planner/evaluation.h"
#include "planner/plan.h"
#include "planner/search_parameters.h"
#include "sim/image.h"
#include "tools/figures/sheet.h"
#include "tools/figures/task_table.h"

namespace prospect::figures {

/// One step of an imagined course of action as it is drawn.
struct Cell {
  std::string above;  ///< the action
  sim::Image picture;
  std::vector<std::string> below;  ///< V, f
  bool bad = false;                ///< a red frame
};

/// An imagined course of action: a picture a step, and what became of it.
struct Strip {
  std::string heading;
  std::vector<Cell> cells;
  std::string verdict;
  Color color = kInk;  ///< of heading and verdict
};

/// Draws strips from `y` on, line after line, as many in a line as fit the sheet. Returns the y
/// below.
int DrawStrips(Sheet* sheet, int y, const std::vector<Strip>& strips);
/// How wide a sheet should be for these: about nine pictures.
int StripsWidth(const std::vector<Strip>& strips);

/// Cells of a course of action: `states` are the evaluations after each action of `path`.
std::vector<Cell> CellsOf(const TaskTable& table, const planner::Path& path,
                          const std::vector<planner::Evaluation>& states,
                          const std::vector<sim::Image>& pictures,
                          const planner::SearchParameters& parameters);

/// Why a future was given up after its last step, `step` of them (1: the first): in words, with the
/// numbers. `last` is the state after that step, `score` the future's.
std::string WhyRejected(planner::Rejection rejection, int step, const planner::Evaluation& last,
                        double score, const planner::SearchParameters& parameters);

}  // namespace prospect::figures
