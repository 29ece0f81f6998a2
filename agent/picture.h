#pragma once

#include <cstdint>
#include <vector>

namespace prospect::agent {

/// An RGB picture as it travels on the bus: rows from the top, three bytes a pixel. Empty (width 0)
/// when there is none.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
  bool empty() const { return width == 0; }
};

}  // namespace prospect::agent
