#pragma once

#include <memory>

#include "model/inference/convolution.h"

namespace prospect::model::inference {

/// True of windows that MakeWinograd knows: 5 x 5 or 3 x 3, multiples of 16 channels.
bool FitsWinograd(const ConvolutionWeights& weights);

/// A convolution of stride 1 by Winograd's minimal filtering: 4 x 4 output pixels of a 5 x 5 window
/// take 64 products a pair of channels where the window itself takes 400, of a 3 x 3 window 36
/// where it takes 144 (Lavin and Gray 2016). The sums differ from the window's own in their last
/// digits. `doubling` 2 shuffles four outputs each to a pixel of 2 x 2.
std::unique_ptr<Convolution> MakeWinograd(const Kernels& kernels, Grid in,
                                          const ConvolutionWeights& weights, int doubling);

}  // namespace prospect::model::inference
