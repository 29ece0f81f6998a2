#pragma once

#include <cstdint>
#include <vector>

namespace prospect::sim {

// An RGB picture: 8 bits a channel, row major, row 0 at the top, three interleaved channels a pixel
// (height x width x 3). Plain data: it may be copied and moved freely.
struct Image {
  int width = 0;                  // pixels
  int height = 0;                 // pixels
  std::vector<std::uint8_t> rgb;  // height * width * 3 values

  bool empty() const { return width == 0; }
};

}  // namespace prospect::sim
