#pragma once

#include "model/networks/libtorch.h"

namespace prospect::model {

/// While one lives, this thread's convolutions that a normalisation follows multiply 16-bit bfloat
/// numbers and add them up in 32 bits: mixed precision, for training. Weights, gradients, norms,
/// activations, losses and whatever decides a picture's last digits stay 32-bit floats; bfloat has
/// their range, so losses need no scaling. Worth it on processors that multiply bfloat (AVX512-BF16
/// or AMX, twice the speed) and on CUDA; others compute it slowly.
class MixedPrecision {
 public:
  /// Nothing happens unless `on`.
  explicit MixedPrecision(bool on);
  ~MixedPrecision();
  MixedPrecision(const MixedPrecision&) = delete;
  MixedPrecision& operator=(const MixedPrecision&) = delete;

 private:
  bool before_;
};

/// conv(x), in this thread's precision if `may_round`; `padding` is the convolution's own.
/// [B,in,H,W] to [B,out,H',W'] floats.
torch::Tensor Convolve(torch::nn::Conv2d& conv, const torch::Tensor& x, int64_t padding,
                       bool may_round);

}  // namespace prospect::model
