#include "tools/evaluate/calibrate.h"

#include <algorithm>
#include <cmath>

namespace prospect::tools {

double ConformalThreshold(const std::vector<SceneRecord>& scenes, double alpha, int* solvable) {
  std::vector<double> scores;
  for (const SceneRecord& scene : scenes) {
    if (scene["class"] == "solvable") scores.push_back(scene["rows"]["planner"]["score"]);
  }
  std::sort(scores.begin(), scores.end());
  *solvable = static_cast<int>(scores.size());
  const auto k = static_cast<std::size_t>(std::floor(alpha * (scores.size() + 1.0)));
  return k == 0 ? 0 : scores[std::min(k, scores.size()) - 1];
}

}  // namespace prospect::tools
