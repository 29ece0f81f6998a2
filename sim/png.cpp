#include "sim/png.h"

#include <png.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "base/atomic_file.h"

namespace prospect::sim {

void WritePng(const std::string& path, const Image& image) {
  png_image header;
  std::memset(&header, 0, sizeof(header));
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  std::string png;
  for (const bool sized : {false, true}) {  // asked for the size first
    if (sized) png.resize(size);
    if (png_image_write_to_memory(&header, sized ? png.data() : nullptr, &size, 0, image.rgb.data(),
                                  0, nullptr) == 0) {
      throw std::runtime_error("cannot make the picture " + path + ": " + header.message);
    }
  }
  png.resize(size);
  base::WriteFile(path, png);
}

Image Enlarge(const Image& image, int factor) {
  Image large{image.width * factor, image.height * factor, {}};
  large.rgb.resize(static_cast<std::size_t>(large.width) * large.height * 3);
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) {
      const std::size_t from =
          (static_cast<std::size_t>(y / factor) * image.width + x / factor) * 3;
      const std::size_t to = (static_cast<std::size_t>(y) * large.width + x) * 3;
      std::copy_n(&image.rgb[from], 3, &large.rgb[to]);
    }
  }
  return large;
}

void Paste(const Image& tile, int x, int y, Image* canvas) {
  const int first = std::max(0, -x);
  const int last = std::min(tile.width, canvas->width - x);
  if (first >= last) return;
  for (int row = std::max(0, -y); row < std::min(tile.height, canvas->height - y); ++row) {
    const std::size_t from = (static_cast<std::size_t>(row) * tile.width + first) * 3;
    const std::size_t to = (static_cast<std::size_t>(row + y) * canvas->width + x + first) * 3;
    std::copy_n(&tile.rgb[from], static_cast<std::size_t>(last - first) * 3, &canvas->rgb[to]);
  }
}

}  // namespace prospect::sim
