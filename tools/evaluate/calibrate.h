#pragma once

#include <vector>

#include "tools/evaluate/report.h"

namespace prospect::tools {

// The refusal threshold by class-conditional split conformal prediction: of the scores that plans
// of solvable calibration scenes got, the k-th smallest with k = floor(alpha (n + 1)). A new
// solvable scene, drawn like these, then scores below it with probability at most alpha. Returns 0
// (refuse nothing) when k is 0. `solvable` is set to n.
double ConformalThreshold(const std::vector<SceneRecord>& scenes, double alpha, int* solvable);

}  // namespace prospect::tools
