#include "tools/common/interval.h"

#include <algorithm>
#include <cmath>

namespace prospect::tools {

Share ShareOf(int count, int total) {
  Share share{count, total, 0, 0, 1};
  if (total == 0) return share;
  constexpr double kZ = 1.959964;  // 97.5 % point of the normal distribution
  const double n = total;
  const double p = count / n;
  const double centre = (p + kZ * kZ / (2 * n)) / (1 + kZ * kZ / n);
  const double half = kZ * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n)) / (1 + kZ * kZ / n);
  share.value = p;
  share.low = std::max(0.0, centre - half);
  share.high = std::min(1.0, centre + half);
  return share;
}

}  // namespace prospect::tools
