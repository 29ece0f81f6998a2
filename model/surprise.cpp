#include "model/surprise.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>

namespace prospect::model {
namespace {

int Colourfulness(const std::uint8_t* pixel) {
  const auto [least, most] = std::minmax({pixel[0], pixel[1], pixel[2]});
  return most - least;
}

// 0 to 5 x 255; 6 x 255 would be all that could differ.
int Difference(const std::uint8_t* a, const std::uint8_t* b) {
  int channels = 0;
  for (int c = 0; c < 3; ++c) channels += std::abs(int{a[c]} - int{b[c]});
  return channels + 3 * std::abs(Colourfulness(a) - Colourfulness(b));
}

// Sums of differences over all pixels above and left of each corner: (height + 1) x (width + 1).
std::vector<int> SummedDifferences(const std::vector<std::uint8_t>& a,
                                   const std::vector<std::uint8_t>& b, int width, int height) {
  const int columns = width + 1;
  std::vector<int> sums(static_cast<std::size_t>(columns) * (height + 1), 0);
  for (int y = 0; y < height; ++y) {
    int row = 0;
    for (int x = 0; x < width; ++x) {
      const std::size_t pixel = (static_cast<std::size_t>(y) * width + x) * 3;
      row += Difference(&a[pixel], &b[pixel]);
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
  return most / (side * side * 6 * 255.0);
}

}  // namespace prospect::model
