#include "model/surprise.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>

namespace prospect::model {
namespace {

// Sums of differences over all pixels above and left of each corner: (height + 1) x (width + 1).
std::vector<int> SummedDifferences(const std::vector<std::uint8_t>& a,
                                   const std::vector<std::uint8_t>& b, int width, int height) {
  const int columns = width + 1;
  std::vector<int> sums(static_cast<std::size_t>(columns) * (height + 1), 0);
  for (int y = 0; y < height; ++y) {
    int row = 0;
    for (int x = 0; x < width; ++x) {
      const std::size_t pixel = (static_cast<std::size_t>(y) * width + x) * 3;
      for (std::size_t c = pixel; c < pixel + 3; ++c) row += std::abs(int{a[c]} - int{b[c]});
      sums[(y + 1) * columns + x + 1] = sums[y * columns + x + 1] + row;
    }
  }
  return sums;
}

}  // namespace

double Surprise(const std::vector<std::uint8_t>& imagined, const std::vector<std::uint8_t>& seen,
                int width, int height) {
  const std::size_t bytes = static_cast<std::size_t>(width) * height * 3;
  if (imagined.size() != bytes || seen.size() != bytes)
    throw std::invalid_argument("the pictures to compare are of other sizes");
  const std::vector<int> sums = SummedDifferences(imagined, seen, width, height);
  const int columns = width + 1, side = kSurprisePatch;
  int most = 0;
  for (int y = 0; y + side <= height; ++y) {
    for (int x = 0; x + side <= width; ++x) {
      const int* upper = &sums[y * columns + x];
      const int* lower = upper + side * columns;
      most = std::max(most, lower[side] - lower[0] - upper[side] + upper[0]);
    }
  }
  return most / (side * side * 3 * 255.0);
}

}  // namespace prospect::model
