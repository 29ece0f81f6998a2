#include "report/color.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace prospect::report {

Color HeatColor(double share) {
  // Equidistant points of viridis; between them the colours run straight.
  static constexpr Color kPoints[] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
                                      {44, 113, 142}, {33, 144, 141}, {39, 173, 129},
                                      {92, 200, 99},  {170, 220, 50}, {253, 231, 37}};
  constexpr int kLast = static_cast<int>(std::size(kPoints)) - 1;
  const double at = std::clamp(share, 0.0, 1.0) * kLast;
  const int low = std::min(static_cast<int>(at), kLast - 1);
  const double part = at - low;
  const auto mix = [part](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + part * (b - a)));
  };
  const Color& a = kPoints[low];
  const Color& b = kPoints[low + 1];
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

}  // namespace prospect::report
