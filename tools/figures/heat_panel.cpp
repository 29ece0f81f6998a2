#include "tools/figures/heat_panel.h"

#include <algorithm>

#include "tools/figures/page.h"

namespace prospect::figures {

int FactorFor(int pixels) { return std::max(1, kSide / std::max(1, pixels)); }

void DrawHeat(Sheet* sheet, int x, int y, const ChannelMean& mean, const Range& range) {
  sheet->Picture(x, y, HeatMap(mean, range), FactorFor(std::max(mean.width, mean.height)));
}

void DrawScale(Sheet* sheet, int x, int y, const Range& range) {
  constexpr int kWidth = 14, kNumbers = 5;
  for (int row = 0; row < kSide; ++row) {
    sheet->Fill(x, y + row, kWidth, 1, HeatColor(1 - row / double(kSide - 1)));
  }
  for (int i = 0; i < kNumbers; ++i) {
    const double share = i / double(kNumbers - 1);
    const int at = y + static_cast<int>((1 - share) * (kSide - 1));
    sheet->Line(x + kWidth, at, x + kWidth + 4, at, kInk, 1);
    sheet->Text(x + kWidth + 7, at - 8,
                Number("%.2f", range.low + share * (range.high - range.low)), kSmallStyle);
  }
}

}  // namespace prospect::figures
