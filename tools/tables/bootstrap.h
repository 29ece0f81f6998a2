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

/// How much more the mean of `trials` is than that of `others`: the same trials, in the same order,
/// seen by two models. Each draw takes the same trials of both, so what makes a trial hard for
/// either does not widen the interval. Throws std::invalid_argument if their numbers differ.
Estimate BootstrapDifference(const std::vector<TrialSums>& trials,
                             const std::vector<TrialSums>& others, Column column);

}  // namespace prospect::tools
