#include "tools/figures/cells.h"

#include "report/number.h"

namespace prospect::figures {

using report::Cell;
using report::Number;

namespace {

constexpr double kSureDone = 0.5;  // f is told where it is lower

}  // namespace

std::vector<Cell> CellsOf(const TaskTable& table, const planner::Path& path,
                          const std::vector<planner::Evaluation>& states,
                          const std::vector<sim::Image>& pictures,
                          const planner::SearchParameters& parameters) {
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const planner::Evaluation& state = states[k];
    Cell cell{std::to_string(k + 1) + ". " + table.Name(path[k]),
              pictures[k],
              {Number("V %.2f", state.value)},
              false};
    if (state.done < kSureDone) cell.below.push_back(Number("f %.2f", state.done));
    cell.bad = state.done < parameters.c_done || state.value < parameters.v_failed;
    cells.push_back(std::move(cell));
  }
  return cells;
}

std::string WhyRejected(planner::Rejection rejection, int step, const planner::Evaluation& last,
                        double score, const planner::SearchParameters& parameters) {
  const std::string where = "step " + std::to_string(step);
  switch (rejection) {
    case planner::Rejection::kNotDone:
      return where + " would not finish: f " + Number("%.2f", last.done) +
             Number(" < %.2f", parameters.c_done);
    case planner::Rejection::kLowValue:
      return "V fell at " + where + ": " + Number("%.2f", last.value) +
             Number(" < %.2f", parameters.v_failed);
    case planner::Rejection::kLowScore:
      return "too unlikely to succeed: score " + Number("%.2f", score) +
             Number(" < %.2f", parameters.refusal_threshold);
    case planner::Rejection::kNotPermitted:
      return where + Number(" cannot follow: p < %.2f", parameters.p_min);
    case planner::Rejection::kNone:
      break;
  }
  return Number("score %.2f", score);
}

}  // namespace prospect::figures
