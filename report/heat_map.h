#pragma once

#include <vector>

#include "report/canvas.h"
#include "sim/image.h"

namespace prospect::report {

inline constexpr int kSide =
    128;  ///< pixels of a picture's longer side on a page, or a little less

/// How often a picture or a heat map of so many pixels is enlarged to come near kSide.
int FactorFor(int pixels);

/// Numbers on a grid, row by row.
struct ValueGrid {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// What the two ends of a heat map's colours stand for.
struct Range {
  double low = 0, high = 1;
};
/// The lowest and the highest of several grids.
Range RangeOf(const std::vector<ValueGrid>& grids);

/// A pixel for each place, `range` from dark to bright.
sim::Image HeatMap(const ValueGrid& grid, const Range& range);

/// Draws a heat map kSide high at (x, y).
void DrawHeat(Canvas* canvas, int x, int y, const ValueGrid& grid, const Range& range);

/// Draws the scale of heat maps of `range` upright at (x, y), kSide high, with its numbers.
void DrawScale(Canvas* canvas, int x, int y, const Range& range);

}  // namespace prospect::report
