#include "tools/ceiling/spread.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

namespace prospect::tools {
namespace {

using Pictures = std::vector<sim::Image>;

void RequireOneSize(const Pictures& pictures) {
  for (const sim::Image& picture : pictures) {
    if (picture.rgb.size() != pictures.front().rgb.size())
      throw std::invalid_argument("pictures of one moment differ in size");
  }
}

std::vector<std::uint8_t> MedianOf(const Pictures& pictures) {
  std::vector<std::uint8_t> median(pictures.front().rgb.size());
  std::vector<std::uint8_t> values(pictures.size());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  for (std::size_t i = 0; i < median.size(); ++i) {
    for (std::size_t p = 0; p < pictures.size(); ++p) values[p] = pictures[p].rgb[i];
    std::nth_element(values.begin(), middle, values.end());
    median[i] = *middle;
  }
  return median;
}

double ErrorFrom(const std::vector<std::uint8_t>& median, const Pictures& pictures) {
  double sum = 0;
  for (const sim::Image& picture : pictures) {
    for (std::size_t i = 0; i < median.size(); ++i) sum += std::abs(median[i] - picture.rgb[i]);
  }
  return sum / 255 / static_cast<double>(median.size() * pictures.size());
}

}  // namespace

PictureErrors ErrorsOf(const Pictures& first, const Pictures& second) {
  if (first.empty() || second.empty()) return {};
  Pictures all = first;
  all.insert(all.end(), second.begin(), second.end());
  RequireOneSize(all);
  return {true, ErrorFrom(MedianOf(first), second), ErrorFrom(MedianOf(all), all)};
}

}  // namespace prospect::tools
