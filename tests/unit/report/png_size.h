#pragma once

#include <fstream>
#include <string>

namespace prospect::report {

/// Pixels of a picture.
struct Size {
  unsigned width = 0, height = 0;
};

/// Of a PNG file, from its header; 0 x 0 where there is none.
inline Size PngSize(const std::string& path) {
  unsigned char head[24] = {};
  std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(head), sizeof head);
  const auto number = [&](int at) {
    return static_cast<unsigned>(head[at] << 24 | head[at + 1] << 16 | head[at + 2] << 8 |
                                 head[at + 3]);
  };
  return {number(16), number(20)};
}

}  // namespace prospect::report
