#include "sim/traced_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace prospect::sim {
namespace {

std::uint8_t ToByte(float value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value * 255.f), 0L, 255L));
}

// Whether a pixel's four corners show nearly one colour; their mean goes to *color.
bool Agree(const Color above[2], const Color below[2], float alike, Color* color) {
  const Color low = above[0].cwiseMin(above[1]).cwiseMin(below[0]).cwiseMin(below[1]);
  const Color high = above[0].cwiseMax(above[1]).cwiseMax(below[0]).cwiseMax(below[1]);
  *color = (above[0] + above[1] + below[0] + below[1]) * 0.25f;
  return (high - low).maxCoeff() < alike;
}

// The colours along the upper edges' corners of pixel row `y`: width + 1 of them, and room for what
// fills the last lanes.
void Corners(const TraceRays& trace, int y, int width, int height, std::vector<Color>* corners) {
  corners->resize(static_cast<std::size_t>(width) + kLanes);
  for (int x = 0; x <= width; x += kLanes) {
    float u[kLanes], v[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      u[i] = static_cast<float>(x + i) / width;
      v[i] = static_cast<float>(y) / height;
    }
    trace(u, v, corners->data() + x);
  }
}

Color FinePixel(const TraceRays& trace, int x, int y, int width, int height) {
  float u[kLanes], v[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    u[i] = (static_cast<float>(x) + (i % 2 == 0 ? 0.25f : 0.75f)) / width;
    v[i] = (static_cast<float>(y) + (i / 2 == 0 ? 0.25f : 0.75f)) / height;
  }
  Color colors[kLanes];
  trace(u, v, colors);
  return (colors[0] + colors[1] + colors[2] + colors[3]) * 0.25f;
}

}  // namespace

void CheckPictureSize(int width, int height) {
  if (width < 1 || height < 1 || width > 4096 || height > 4096) {
    throw std::invalid_argument("a picture is 1 to 4096 pixels wide and high");
  }
}

Image TracedPicture(int width, int height, float alike, double light, const TraceRays& trace) {
  CheckPictureSize(width, height);
  Image image;
  image.width = width;
  image.height = height;
  image.rgb.resize(static_cast<std::size_t>(width) * height * 3);
  std::uint8_t* pixel = image.rgb.data();
  std::vector<Color> above, below;
  Corners(trace, 0, width, height, &above);
  for (int y = 0; y < height; ++y, above.swap(below)) {
    Corners(trace, y + 1, width, height, &below);
    for (int x = 0; x < width; ++x) {
      Color color;
      if (!Agree(above.data() + x, below.data() + x, alike, &color)) {
        color = FinePixel(trace, x, y, width, height);
      }
      color *= static_cast<float>(light);
      for (int k = 0; k < 3; ++k) *pixel++ = ToByte(color[k]);
    }
  }
  return image;
}

}  // namespace prospect::sim
