// Numbers for people, with as many decimals as it takes to tell them from what they are compared
// with: "0.0316, below 0.0320" and not "0.03, below 0.03".
#pragma once

#include <string>

namespace prospect::planner {

// `x` with `digits` decimals.
std::string Fixed(double x, int digits);

// Decimals, at least `fewest` and at most 6, at which the two differ.
int DigitsApart(double a, double b, int fewest = 2);

// `x` with at least `fewest` decimals, or as many as it takes (up to 6) to tell it from `other`.
std::string Apart(double x, double other, int fewest = 2);

}  // namespace prospect::planner
