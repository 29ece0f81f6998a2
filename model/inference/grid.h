#pragma once

#include <cstddef>

namespace prospect::model::inference {

/// Height and width of a map of features.
struct Grid {
  int height = 0, width = 0;
  int pixels() const { return height * width; }
  bool operator==(const Grid&) const = default;
};

/// Numbers in a map.
inline std::size_t MapSize(Grid grid, int channels) {
  return static_cast<std::size_t>(grid.pixels()) * static_cast<std::size_t>(channels);
}

}  // namespace prospect::model::inference
