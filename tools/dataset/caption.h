#pragma once

#include <string>

#include "sim/image.h"

namespace prospect::tools {

// Writes dark small text into a picture, its upper left corner at (x, y); 12 pixels high and about
// 6 wide a letter. Builds without OpenCV write nothing.
void DrawCaption(const std::string& text, int x, int y, sim::Image* image);

}  // namespace prospect::tools
