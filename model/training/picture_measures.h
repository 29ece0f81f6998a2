#pragma once

#include <torch/torch.h>

namespace prospect::model {

/// Peak signal-to-noise ratio of each picture [B,3,H,W] in [0,1] against its goal, in decibels:
/// [B]. Equal pictures get 100.
torch::Tensor Psnr(const torch::Tensor& x, const torch::Tensor& goal);

/// Structural similarity of each picture [B,3,H,W] in [0,1] to its goal (Wang et al. 2004: Gaussian
/// window of 11 pixels and sigma 1.5, K1 = 0.01, K2 = 0.03), mean over windows that lie inside and
/// over the three channels: [B]. 1 for equal pictures. Pictures are at least 11 pixels on a side.
torch::Tensor Ssim(const torch::Tensor& x, const torch::Tensor& goal);

}  // namespace prospect::model
