// What the machine could do at best: the speed of large matrix products.
#pragma once

#include <torch/torch.h>

namespace prospect::tools {

// GFLOP/s (a multiply-add is two) of products of large square matrices, the best of several tries:
// on the CPU `threads` single-threaded products of floats side by side, as training spreads its
// shards; on CUDA one at a time, of floats or of half floats, whichever is faster.
double MatrixPeakGflops(const torch::Device& device, int threads);

}  // namespace prospect::tools
