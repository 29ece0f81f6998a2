#pragma once

#include <cstdint>
#include <vector>

#include "base/sensor_noise.h"
#include "sim/task.h"

namespace prospect::tools {

// Sets scene `seed` up and looks at it as its camera does at the start: RGB, rows from the top,
// with sensor noise of standard deviation `image_noise` (share of full range).
inline std::vector<std::uint8_t> FirstPicture(sim::Task& task, std::uint64_t seed,
                                              double image_noise) {
  task.Reset(seed);
  std::vector<std::uint8_t> pixels = task.Observe().rgb;
  base::AddSensorNoise(pixels.data(), pixels.size(), seed, 0, image_noise);
  return pixels;
}

}  // namespace prospect::tools
