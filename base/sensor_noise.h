#pragma once

#include <cstddef>
#include <cstdint>

namespace prospect::base {

/// The camera's sensor noise, added over clean frames wherever they are read (the bus, the reader
/// of data sets), so that all see the same pictures while what is stored compresses well.
///
/// Adds Gaussian noise of standard deviation `sigma` (a share of full range, 0 to 0.25; 0.01
/// is 2.55 grey levels) to `n` 8-bit values, rounded and clamped to 0..255. The noise of value i
/// depends on (trial_seed, frame, i) and sigma alone: not on n, the picture, the thread or any call
/// before. `frame` counts from 0 at the trial's first picture. Throws std::invalid_argument if
/// sigma is out of range. Safe to call from several threads.
void AddSensorNoise(std::uint8_t* rgb, std::size_t n, std::uint64_t trial_seed, std::int64_t frame,
                    double sigma);

}  // namespace prospect::base
