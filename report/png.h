#pragma once

#include <string>

#include "sim/image.h"

namespace prospect::report {

/// The bytes of a PNG file that shows the picture (libpng). Throws std::runtime_error for a picture
/// without pixels.
std::string EncodePng(const sim::Image& image);

/// A PNG file for people to look at, whole or not at all. Throws base::DiskError naming the file
/// and the cause, and as EncodePng.
void WritePng(const std::string& path, const sim::Image& image);

}  // namespace prospect::report
