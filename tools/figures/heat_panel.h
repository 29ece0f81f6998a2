#pragma once

#include <vector>

#include "tools/figures/imagined.h"
#include "tools/figures/sheet.h"

namespace prospect::figures {

inline constexpr int kSide =
    128;  ///< pixels of a picture's longer side on a page, or a little less

/// How often a picture or a heat map of so many pixels is enlarged to come near kSide.
int FactorFor(int pixels);

/// Draws a heat map kSide high at (x, y).
void DrawHeat(Sheet* sheet, int x, int y, const ChannelMean& mean, const Range& range);

/// Draws the scale of heat maps of `range` upright at (x, y), kSide high, with its numbers.
void DrawScale(Sheet* sheet, int x, int y, const Range& range);

}  // namespace prospect::figures
