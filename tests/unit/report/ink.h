#pragma once

#include <algorithm>

#include "sim/image.h"

namespace prospect::report {

/// Whether a pixel is white.
inline bool IsPaper(const sim::Image& image, int x, int y) {
  const std::size_t at = (static_cast<std::size_t>(y) * image.width + x) * 3;
  return image.rgb[at] == 255 && image.rgb[at + 1] == 255 && image.rgb[at + 2] == 255;
}

/// The box around everything that is not paper; empty (right < left) if there is nothing.
struct Ink {
  int left, right = -1, top, bottom = -1;
};
inline Ink InkOf(const sim::Image& image) {
  Ink ink{image.width, -1, image.height, -1};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (IsPaper(image, x, y)) continue;
      ink = {std::min(ink.left, x), std::max(ink.right, x), std::min(ink.top, y),
             std::max(ink.bottom, y)};
    }
  }
  return ink;
}

/// A picture of one colour.
inline sim::Image Plain(int width, int height, std::uint8_t value) {
  sim::Image image{width, height, {}};
  image.rgb.assign(static_cast<std::size_t>(width) * height * 3, value);
  return image;
}

}  // namespace prospect::report
