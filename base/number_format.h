#pragma once

#include <string>

namespace prospect::base {

/// A number as printf writes it: Number("%.2f", 0.123) is "0.12". `format` has one conversion, of a
/// double.
std::string Number(const char* format, double value);

/// `value` with so many decimals.
std::string Fixed(double value, int decimals);

// Numbers for people, with as many decimals as it takes to tell them from what they are compared
// with: "0.0316, below 0.0320" and not "0.03, below 0.03".

/// Decimals, at least `fewest` and at most 6, at which the two differ.
int DigitsApart(double a, double b, int fewest = 2);

/// `value` with at least `fewest` decimals, or as many as it takes (up to 6) to tell it from
/// `other`.
std::string Apart(double value, double other, int fewest = 2);

}  // namespace prospect::base
