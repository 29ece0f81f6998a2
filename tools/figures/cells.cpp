#include "tools/figures/cells.h"

#include "base/number_format.h"

namespace prospect::figures {

using report::Cell;

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
              {base::Number("V %.2f", state.value)},
              false};
    if (state.done < kSureDone) cell.below.push_back(base::Number("f %.2f", state.done));
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
      return where + " would not finish: f " + base::Number("%.2f", last.done) +
             base::Number(" < %.2f", parameters.c_done);
    case planner::Rejection::kLowValue:
      return "V fell at " + where + ": " + base::Number("%.2f", last.value) +
             base::Number(" < %.2f", parameters.v_failed);
    case planner::Rejection::kLowScore:
      return "too unlikely to succeed: score " + base::Number("%.2f", score) +
             base::Number(" < %.2f", parameters.refusal_threshold);
    case planner::Rejection::kNotPermitted:
      return where + base::Number(" cannot follow: p < %.2f", parameters.p_min);
    case planner::Rejection::kNone:
      break;
  }
  return base::Number("score %.2f", score);
}

}  // namespace prospect::figures
