#include "model/inference/painting.h"

#include <algorithm>
#include <cmath>

namespace prospect::model::inference {
namespace {

/// The light of what was seen over that of its redrawing, by least squares.
float LightGain(const SeenPicture& start) {
  double both = 0, own = 0;
  for (std::size_t i = 0; i < start.seen.size(); ++i) {
    both += double{start.seen[i]} * start.decoded_start[i];
    own += double{start.decoded_start[i]} * start.decoded_start[i];
  }
  return static_cast<float>(both / std::max(own, 1e-6));
}

/// How much of each pixel is painted anew, 0 to 1 (ComposePicture in model/networks/light.cpp has
/// the reasons).
std::vector<float> Changed(const SeenPicture& start, float gain, const float* decoded) {
  constexpr float kSame = 0.16F, kOther = 0.28F;
  std::vector<float> changed(start.seen.size() / 3);
  for (std::size_t p = 0; p < changed.size(); ++p) {
    float most = 0;
    for (std::size_t i = 3 * p; i < 3 * p + 3; ++i)
      most = std::max(most, std::abs((decoded[i] - start.decoded_start[i]) * gain));
    changed[p] = std::clamp((most - kSame) / (kOther - kSame), 0.0F, 1.0F);
  }
  return changed;
}

/// The largest of each pixel and the eight around it.
std::vector<float> Touched(const std::vector<float>& changed, Grid grid) {
  std::vector<float> touched(changed.size());
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      float most = 0;
      for (int j = std::max(0, y - 1); j <= std::min(grid.height - 1, y + 1); ++j) {
        for (int i = std::max(0, x - 1); i <= std::min(grid.width - 1, x + 1); ++i)
          most = std::max(most, changed[static_cast<std::size_t>(j * grid.width + i)]);
      }
      touched[static_cast<std::size_t>(y * grid.width + x)] = most;
    }
  }
  return touched;
}

}  // namespace

void PaintOnto(const SeenPicture& start, Grid grid, bool compose, float* decoded) {
  const float gain = LightGain(start);
  std::vector<float> touched;
  if (compose) touched = Touched(Changed(start, gain, decoded), grid);
  for (std::size_t i = 0; i < start.seen.size(); ++i) {
    float value = decoded[i] * gain;
    if (compose) value = start.seen[i] + touched[i / 3] * (value - start.seen[i]);
    decoded[i] = std::clamp(value, 0.0F, 1.0F);
  }
}

void ToBytes(const float* picture, std::size_t count, std::uint8_t* bytes) {
  for (std::size_t i = 0; i < count; ++i)
    bytes[i] =
        static_cast<std::uint8_t>(std::clamp(std::nearbyint(picture[i] * 255.0F), 0.0F, 255.0F));
}

}  // namespace prospect::model::inference
