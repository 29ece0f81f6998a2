#include "report/heat_map.h"

#include <algorithm>
#include <limits>

#include "base/number_format.h"

namespace prospect::report {

int FactorFor(int pixels) { return std::max(1, kSide / std::max(1, pixels)); }

Range RangeOf(const std::vector<ValueGrid>& grids) {
  Range range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const ValueGrid& grid : grids) {
    for (const float value : grid.values) {
      range.low = std::min(range.low, static_cast<double>(value));
      range.high = std::max(range.high, static_cast<double>(value));
    }
  }
  return range;
}

sim::Image HeatMap(const ValueGrid& grid, const Range& range) {
  const double span = std::max(1e-9, range.high - range.low);
  sim::Image image{grid.width, grid.height, {}};
  for (const float value : grid.values) {
    const Color color = HeatColor((value - range.low) / span);
    image.rgb.insert(image.rgb.end(), {color.r, color.g, color.b});
  }
  return image;
}

void DrawHeat(Canvas* canvas, int x, int y, const ValueGrid& grid, const Range& range) {
  canvas->Picture(x, y, HeatMap(grid, range), FactorFor(std::max(grid.width, grid.height)));
}

void DrawScale(Canvas* canvas, int x, int y, const Range& range) {
  constexpr int kWidth = 14, kNumbers = 5;
  for (int row = 0; row < kSide; ++row) {
    canvas->Fill(x, y + row, kWidth, 1, HeatColor(1 - row / double(kSide - 1)));
  }
  for (int i = 0; i < kNumbers; ++i) {
    const double share = i / double(kNumbers - 1);
    const int at = y + static_cast<int>((1 - share) * (kSide - 1));
    canvas->Line(x + kWidth, at, x + kWidth + 4, at, kInk, 1);
    canvas->Text(x + kWidth + 7, at - 8,
                 base::Number("%.2f", range.low + share * (range.high - range.low)), kSmallStyle);
  }
}

}  // namespace prospect::report
