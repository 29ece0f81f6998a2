#pragma once

#include <cstdint>
#include <vector>

#include "tools/tables/columns.h"

namespace prospect::tools {

/// A mean over examples with its 95 % interval by drawing whole trials anew, because examples of
/// one trial resemble each other.
struct Estimate {
  double value = 0, low = 0, high = 0;
  double examples = 0;
};

/// Percentiles of 1,000 draws, always the same ones for the same number of trials. All zero if no
/// trial has an example.
Estimate Bootstrap(const std::vector<TrialSums>& trials, Column column);

}  // namespace prospect::tools
