#include "tools/figures/strip.h"

#include <algorithm>

#include "tools/figures/heat_panel.h"
#include "tools/figures/page.h"

namespace prospect::figures {
namespace {

constexpr int kColumn = kSide + 10;
constexpr double kSureDone = 0.5;  // f is told where it is lower
constexpr Style kFigureStyle{0.42, kInk, false};
constexpr Style kBadStyle{0.42, kBad, false};

constexpr int kCellsAcross = 9, kGap = 18;

int PictureTop() { return Sheet::LineHeight(kBodyStyle) + 2 * Sheet::LineHeight(kFigureStyle); }

// Verdicts of short strips need some room, too.
int StripWidth(const Strip& strip) {
  const int verdict = std::min(3 * kColumn, Sheet::TextWidth(strip.verdict, kBodyStyle) + 4);
  return std::max(verdict, static_cast<int>(strip.cells.size()) * kColumn);
}

void DrawCell(Sheet* sheet, int x, int names, int top, const Cell& cell) {
  sheet->Paragraph(x, names, kSide, cell.above, kFigureStyle);
  sheet->Picture(x, top, cell.picture,
                 FactorFor(std::max(cell.picture.width, cell.picture.height)));
  if (cell.bad) sheet->Frame(x, top, kSide, kSide, kBad, 4);
  int below = top + kSide + 5;
  for (const std::string& line : cell.below) {
    below = sheet->Text(x, below, line, cell.bad ? kBadStyle : kFigureStyle);
  }
}

// Returns the y below.
int DrawStrip(Sheet* sheet, int x, int y, int width, const Strip& strip) {
  const Style style{kBodyStyle.size, strip.color, false};
  const int names = sheet->Text(x, y, strip.heading, style);
  const int top = y + PictureTop();
  std::size_t lines = 0;
  int left = x;
  for (const Cell& cell : strip.cells) {
    DrawCell(sheet, left, names, top, cell);
    lines = std::max(lines, cell.below.size());
    left += kColumn;
  }
  const int below = top + kSide + 6 + static_cast<int>(lines) * Sheet::LineHeight(kFigureStyle);
  return sheet->Paragraph(x, below, width, strip.verdict, style);
}

}  // namespace

int StripsWidth(const std::vector<Strip>& strips) {
  std::size_t longest = 1;
  for (const Strip& strip : strips) longest = std::max(longest, strip.cells.size());
  const int steps = static_cast<int>(longest);
  const int across = std::max(1, kCellsAcross / steps);
  return 2 * kMargin + across * steps * kColumn + (across - 1) * kGap;
}

int DrawStrips(Sheet* sheet, int y, const std::vector<Strip>& strips) {
  const int right = sheet->width() - kMargin;
  int x = kMargin, bottom = y;
  for (const Strip& strip : strips) {
    const int width = StripWidth(strip);
    if (x > kMargin && x + width > right + kGap) {
      sheet->Line(kMargin, bottom + 8, right, bottom + 8, kRule, 1);
      y = bottom + 16;
      x = kMargin;
    }
    bottom = std::max(bottom, DrawStrip(sheet, x, y, width, strip));
    x += width + kGap;
  }
  return bottom;
}

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
