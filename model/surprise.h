#pragma once

#include <cstdint>
#include <vector>

/// How far what is seen lies from what was imagined. Pure functions, safe from any thread; no
/// libtorch.
namespace prospect::model {

/// Side of the patches that are compared, pixels: about a block of the stacking scene.
inline constexpr int kSurprisePatch = 6;

/// The greatest mean absolute difference, 0 to 1, of any patch of kSurprisePatch x kSurprisePatch
/// pixels of two pictures (height x width x 3 bytes RGB, rows from the top). A mean over the whole
/// picture would not do: one block that is not where it should be is a hundredth of it. 0 for
/// pictures that are smaller than a patch. Throws std::invalid_argument where sizes do not fit.
double Surprise(const std::vector<std::uint8_t>& imagined, const std::vector<std::uint8_t>& seen,
                int width, int height);

}  // namespace prospect::model
