#pragma once

#include <functional>

namespace prospect::tools {

// Exit codes of the tools that work on data sets and weights (docs/architecture.md).
constexpr int kExitUsage = 2, kExitFailed = 4, kExitWeights = 10, kExitDisk = 13, kExitData = 14;

// run()'s code, or that of the error it threw, which is told on standard error after the program's
// name: data 14, weights 10, disk 13, Interrupted 130, usage (std::invalid_argument) 2, a
// computation that has no result or no memory (std::range_error, libtorch) 4; `others` for all
// others.
int Guarded(const char* program, const std::function<int()>& run, int others = kExitDisk);

}  // namespace prospect::tools
