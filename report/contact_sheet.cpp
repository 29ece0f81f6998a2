#include "report/contact_sheet.h"

#include <algorithm>

#include "report/canvas.h"
#include "report/image_edit.h"
#include "report/page.h"

namespace prospect::report {
namespace {

// Pixels.
constexpr int kWidth = 128;   // a picture at least so wide, so that a name fits under it
constexpr int kCaption = 16;  // under a picture
constexpr int kGap = 4;
constexpr int kLine = 18;  // the title, and the line above a row

constexpr Style kWords{0.36, kInk, false};

// Where the pictures of a row stand: side by side while they fit a screen, then below.
struct Grid {
  int factor = 1;
  int wide = 0, high = 0;  // a picture's place
  int columns = 1;

  explicit Grid(const ContactSheet& sheet) {
    std::size_t most = 1;
    for (const ContactSheet::Row& row : sheet.rows) most = std::max(most, row.cells.size());
    const auto filled =
        std::find_if(sheet.rows.begin(), sheet.rows.end(),
                     [](const ContactSheet::Row& row) { return !row.cells.empty(); });
    const sim::Image& first = filled->cells.front().picture;
    factor = std::max(1, kWidth / first.width);
    wide = first.width * factor + kGap;
    high = first.height * factor + kCaption + kGap;
    columns = std::clamp(kMostWidth / wide, 1, static_cast<int>(most));
  }
};

// Returns the y below.
int DrawRow(Canvas* canvas, const ContactSheet::Row& row, const Grid& grid, int y) {
  canvas->Text(2, y + 2, row.heading, kWords);
  y += kLine;
  int column = 0;
  for (const ContactSheet::Cell& cell : row.cells) {
    if (column == grid.columns) {
      y += grid.high;
      column = 0;
    }
    const int x = column++ * grid.wide;
    canvas->Picture(x, y, cell.picture, grid.factor);
    canvas->Text(x + 2, y + cell.picture.height * grid.factor + 2, cell.words, kWords);
  }
  return row.cells.empty() ? y : y + grid.high;
}

}  // namespace

sim::Image Draw(const ContactSheet& sheet) {
  const Grid grid(sheet);
  Canvas canvas(std::max(kLeastWidth, grid.columns * grid.wide));
  canvas.Text(2, 2, sheet.title, kWords);
  int y = kLine;
  for (const ContactSheet::Row& row : sheet.rows) y = DrawRow(&canvas, row, grid, y);
  return canvas.Cut(y);
}

}  // namespace prospect::report
