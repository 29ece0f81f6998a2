#include "report/strip.h"

#include <algorithm>

#include "report/heat_map.h"
#include "report/page.h"

namespace prospect::report {
namespace {

constexpr int kColumn = kSide + 10;
constexpr Style kFigureStyle{0.42, kInk, false};
constexpr Style kBadStyle{0.42, kBad, false};

constexpr int kCellsAcross = 9, kGap = 18;

int PictureTop() { return Canvas::LineHeight(kBodyStyle) + 2 * Canvas::LineHeight(kFigureStyle); }

// Verdicts of short strips need some room, too.
int StripWidth(const Strip& strip) {
  const int verdict = std::min(3 * kColumn, Canvas::TextWidth(strip.verdict, kBodyStyle) + 4);
  return std::max(verdict, static_cast<int>(strip.cells.size()) * kColumn);
}

void DrawCell(Canvas* canvas, int x, int names, int top, const Cell& cell) {
  canvas->Paragraph(x, names, kSide, cell.above, kFigureStyle);
  canvas->Picture(x, top, cell.picture,
                  FactorFor(std::max(cell.picture.width, cell.picture.height)));
  if (cell.bad) canvas->Frame(x, top, kSide, kSide, kBad, 4);
  int below = top + kSide + 5;
  for (const std::string& line : cell.below) {
    below = canvas->Text(x, below, line, cell.bad ? kBadStyle : kFigureStyle);
  }
}

// Returns the y below.
int DrawStrip(Canvas* canvas, int x, int y, int width, const Strip& strip) {
  const Style style{kBodyStyle.size, strip.color, false};
  const int names = canvas->Text(x, y, strip.heading, style);
  const int top = y + PictureTop();
  std::size_t lines = 0;
  int left = x;
  for (const Cell& cell : strip.cells) {
    DrawCell(canvas, left, names, top, cell);
    lines = std::max(lines, cell.below.size());
    left += kColumn;
  }
  const int below = top + kSide + 6 + static_cast<int>(lines) * Canvas::LineHeight(kFigureStyle);
  return canvas->Paragraph(x, below, width, strip.verdict, style);
}

}  // namespace

int StripsWidth(const std::vector<Strip>& strips) {
  std::size_t longest = 1;
  for (const Strip& strip : strips) longest = std::max(longest, strip.cells.size());
  const int steps = static_cast<int>(longest);
  const int across = std::max(1, kCellsAcross / steps);
  return 2 * kMargin + across * steps * kColumn + (across - 1) * kGap;
}

int DrawStrips(Canvas* canvas, int y, const std::vector<Strip>& strips) {
  const int right = canvas->width() - kMargin;
  int x = kMargin, bottom = y;
  for (const Strip& strip : strips) {
    const int width = StripWidth(strip);
    if (x > kMargin && x + width > right + kGap) {
      canvas->Line(kMargin, bottom + 8, right, bottom + 8, kRule, 1);
      y = bottom + 16;
      x = kMargin;
    }
    bottom = std::max(bottom, DrawStrip(canvas, x, y, width, strip));
    x += width + kGap;
  }
  return bottom;
}

}  // namespace prospect::report
