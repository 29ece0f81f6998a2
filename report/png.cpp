#include "report/png.h"

#include <png.h>

#include <cstring>
#include <stdexcept>

#include "base/atomic_file.h"

namespace prospect::report {

std::string EncodePng(const sim::Image& image) {
  png_image header;
  std::memset(&header, 0, sizeof(header));
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string png(size, '\0');
  if (png_image_write_to_memory(&header, png.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0)
    throw std::runtime_error(std::string("cannot make a PNG: ") + header.message);
  png.resize(size);
  return png;
}

void WritePng(const std::string& path, const sim::Image& image) {
  base::WriteFile(path, EncodePng(image));
}

}  // namespace prospect::report
