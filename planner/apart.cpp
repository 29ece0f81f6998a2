#include "planner/apart.h"

#include <cstdio>

namespace prospect::planner {
namespace {

constexpr int kMostDigits = 6;

}  // namespace

std::string Fixed(double x, int digits) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", digits, x);
  return text;
}

int DigitsApart(double a, double b, int fewest) {
  int digits = fewest;
  while (a != b && digits < kMostDigits && Fixed(a, digits) == Fixed(b, digits)) ++digits;
  return digits;
}

std::string Apart(double x, double other, int fewest) {
  return Fixed(x, DigitsApart(x, other, fewest));
}

}  // namespace prospect::planner
