#pragma once

#include <functional>

#include "sim/image.h"
#include "sim/mesh.h"

namespace prospect::sim {

inline constexpr int kLanes = 4;  // rays traced together: a pixel's 2 x 2 samples

// The colours that rays through kLanes places of a picture meet: u to the right, v down, 0 to 1
// (and a little beyond: corners are traced kLanes at a time).
using TraceRays =
    std::function<void(const float u[kLanes], const float v[kLanes], Color colors[kLanes])>;

// Throws std::invalid_argument unless width and height are 1 to 4096.
void CheckPictureSize(int width, int height);

// The picture that `trace` sees, in a light scaled by `light`. A pixel is the mean of its corners
// where these differ by less than `alike` (0 to 1) in each channel, and of 2 x 2 samples of its own
// elsewhere: edges are smooth at little more than a ray a pixel.
Image TracedPicture(int width, int height, float alike, double light, const TraceRays& trace);

}  // namespace prospect::sim
