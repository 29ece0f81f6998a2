#pragma once

#include "sim/image.h"

namespace prospect::report {

/// Every pixel repeated factor x factor times (factor >= 1).
sim::Image Enlarge(const sim::Image& image, int factor);

/// As `width` x `height` pixels (1 or more), smoothly (bicubic). `image` has pixels.
sim::Image Resized(const sim::Image& image, int width, int height);

/// The same for pictures that become smaller: each pixel is the mean of what it covers.
sim::Image Scaled(const sim::Image& image, int width, int height);

/// Copies `tile` into *canvas with its top left corner at (x, y); what lies outside is cut off.
void Paste(const sim::Image& tile, int x, int y, sim::Image* canvas);

/// Mean absolute difference of two pictures of one size, as a share of full range; 0 for empty
/// ones.
double MeanAbsoluteError(const sim::Image& a, const sim::Image& b);

}  // namespace prospect::report
