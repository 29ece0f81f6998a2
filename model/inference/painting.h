#pragma once

#include <cstdint>
#include <vector>

#include "model/inference/grid.h"

/// How a decoded picture becomes what is shown, as model/networks/light.h does it for training.
/// Pictures are height x width x 3 numbers from 0 to 1. Pure.
namespace prospect::model::inference {

/// The picture in whose light, and on which, imagined ones are painted.
struct SeenPicture {
  std::vector<float> seen;           ///< what the camera saw
  std::vector<float> decoded_start;  ///< its decoded encoding
};

/// Brings `decoded` to the light of what was seen; with `compose`, what is as it was at the start
/// stays as it was seen. In place.
void PaintOnto(const SeenPicture& start, Grid grid, bool compose, float* decoded);

/// To the nearest of 256 steps.
void ToBytes(const float* picture, std::size_t count, std::uint8_t* bytes);

}  // namespace prospect::model::inference
