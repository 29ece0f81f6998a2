#pragma once

#include <string>

#include "sim/image.h"

namespace prospect::sim {

// PNG files for people to look at (libpng), whole or not at all. Throws base::DiskError naming the
// file and the cause.
void WritePng(const std::string& path, const Image& image);

// Every pixel repeated factor x factor times (factor >= 1).
Image Enlarge(const Image& image, int factor);

// Copies `tile` into *canvas with its top left corner at (x, y); what lies outside is cut off.
void Paste(const Image& tile, int x, int y, Image* canvas);

}  // namespace prospect::sim
