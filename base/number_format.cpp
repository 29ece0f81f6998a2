#include "base/number_format.h"

#include <cstdio>

namespace prospect::base {

std::string Number(const char* format, double value) {
  char text[352];  // the longest double, written out with "%f", has 317 characters
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string Fixed(double value, int decimals) {
  return Number(("%." + std::to_string(decimals) + "f").c_str(), value);
}

int DigitsApart(double a, double b, int fewest) {
  constexpr int kMost = 6;
  int digits = fewest;
  while (a != b && digits < kMost && Fixed(a, digits) == Fixed(b, digits)) ++digits;
  return digits;
}

std::string Apart(double value, double other, int fewest) {
  return Fixed(value, DigitsApart(value, other, fewest));
}

}  // namespace prospect::base
