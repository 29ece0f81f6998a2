#include "sim/shift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace prospect::sim {
namespace {

struct Factor {
  std::string name;
  const char* words;  // of ShiftText
  std::array<double, kShiftStrengths> amounts;
};

// Chosen on tuning scenes: from just outside what trials show to far away from it.
const std::array<Factor, 4>& Factors() {
  static const std::array<Factor, 4> factors = {
      Factor{"light", "light x %g", {0.8, 0.6, 0.4, 0.2, 0.1}},
      Factor{"camera", "camera turned by %g degrees", {1, 2, 4, 8, 16}},
      Factor{"colour", "hues turned by %g degrees", {10, 20, 40, 60, 90}},
      Factor{"noise", "sensor noise of sigma %g", {0.02, 0.04, 0.08, 0.16, 0.25}}};
  return factors;
}

const Factor& Find(const std::string& name) {
  for (const Factor& factor : Factors()) {
    if (factor.name == name) return factor;
  }
  std::string known;
  for (const std::string& one : ShiftFactors()) known += (known.empty() ? "" : ", ") + one;
  throw std::invalid_argument("unknown factor '" + name + "': there are " + known);
}

}  // namespace

const std::vector<std::string>& ShiftFactors() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Factor& factor : Factors()) all.push_back(factor.name);
    return all;
  }();
  return names;
}

double ShiftAmount(const std::string& factor, int strength) {
  const Factor& found = Find(factor);
  if (strength < 1 || strength > kShiftStrengths) {
    throw std::invalid_argument("a shift's strength is " + std::to_string(strength) +
                                ": give 1 to " + std::to_string(kShiftStrengths));
  }
  return found.amounts[static_cast<std::size_t>(strength) - 1];
}

std::string ShiftText(const std::string& factor, int strength) {
  char text[80];
  std::snprintf(text, sizeof text, Find(factor).words, ShiftAmount(factor, strength));
  return text;
}

// Of the six sectors of the colour circle, `h` of 60 degrees each: one channel is brightest, one
// darkest, and the third goes from one to the other.
Color TurnedHue(const Color& color, double degrees) {
  const float high = color.maxCoeff(), low = color.minCoeff(), chroma = high - low;
  if (degrees == 0 || chroma <= 0) return color;
  int first = 0;
  color.maxCoeff(&first);
  const int second = (first + 1) % 3, third = (first + 2) % 3;
  double h = 2 * first + (color[second] - color[third]) / chroma + degrees / 60;
  h -= 6 * std::floor(h / 6);
  Color turned;
  for (int channel = 0; channel < 3; ++channel) {
    double away = std::abs(h - 2 * channel);
    away = std::min(away, 6 - away);  // sectors from where this channel is alone
    turned[channel] = low + chroma * static_cast<float>(std::clamp(2 - away, 0.0, 1.0));
  }
  return turned;
}

}  // namespace prospect::sim
