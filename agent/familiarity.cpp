#include "agent/familiarity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace prospect::agent {
namespace {

constexpr double kWhite = 0.2;  // share of full range that is drawn white

// The light of `seen` over that of `redrawn`, by least squares.
double GainOf(const Picture& seen, const Picture& redrawn) {
  double both = 0, own = 0;
  for (std::size_t i = 0; i < redrawn.rgb.size(); ++i) {
    both += static_cast<double>(seen.rgb[i]) * redrawn.rgb[i];
    own += static_cast<double>(redrawn.rgb[i]) * redrawn.rgb[i];
  }
  return own > 0 ? both / own : 1;
}

}  // namespace

std::string FamiliaritySentence(const Familiarity& familiarity) {
  if (familiarity.foreign())
    return "It is unlike what the networks were trained on: " +
           model::DescribeNovelty(familiarity.novelty) + ".";
  char text[64];
  std::snprintf(text, sizeof text, "The picture is like known ones (p %.2g).",
                familiarity.novelty.p);
  return text;
}

Picture DifferenceMap(const Picture& seen, const Picture& redrawn) {
  if (seen.empty() || seen.width != redrawn.width || seen.height != redrawn.height ||
      seen.rgb.size() != redrawn.rgb.size())
    return {};
  const double gain = std::max(1e-3, GainOf(seen, redrawn));
  Picture map{seen.width, seen.height, {}};
  for (std::size_t i = 0; i + 2 < seen.rgb.size(); i += 3) {
    double sum = 0;
    for (std::size_t k = i; k < i + 3; ++k) sum += std::abs(seen.rgb[k] / gain - redrawn.rgb[k]);
    const double share = std::min(1.0, sum / 3 / 255 / kWhite);
    map.rgb.insert(map.rgb.end(), 3, static_cast<std::uint8_t>(std::lround(255 * share)));
  }
  return map;
}

}  // namespace prospect::agent
