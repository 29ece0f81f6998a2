#include "report/difference_map.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace prospect::report {
namespace {

constexpr double kWhite = 0.2;  // share of full range that is drawn white

// The light of `seen` over that of `redrawn`, by least squares.
double GainOf(const sim::Image& seen, const sim::Image& redrawn) {
  double both = 0, own = 0;
  for (std::size_t i = 0; i < redrawn.rgb.size(); ++i) {
    both += static_cast<double>(seen.rgb[i]) * redrawn.rgb[i];
    own += static_cast<double>(redrawn.rgb[i]) * redrawn.rgb[i];
  }
  return own > 0 ? both / own : 1;
}

}  // namespace

sim::Image DifferenceMap(const sim::Image& seen, const sim::Image& redrawn) {
  if (seen.empty() || seen.width != redrawn.width || seen.height != redrawn.height ||
      seen.rgb.size() != redrawn.rgb.size())
    return {};
  const double gain = std::max(1e-3, GainOf(seen, redrawn));
  sim::Image map{seen.width, seen.height, {}};
  for (std::size_t i = 0; i + 2 < seen.rgb.size(); i += 3) {
    double sum = 0;
    for (std::size_t k = i; k < i + 3; ++k) sum += std::abs(seen.rgb[k] / gain - redrawn.rgb[k]);
    const double share = std::min(1.0, sum / 3 / 255 / kWhite);
    map.rgb.insert(map.rgb.end(), 3, static_cast<std::uint8_t>(std::lround(255 * share)));
  }
  return map;
}

}  // namespace prospect::report
