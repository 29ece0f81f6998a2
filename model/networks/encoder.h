#pragma once

#include "model/network_config.h"
#include "model/networks/blocks.h"

namespace prospect::model {

/// f_enc (paper §III-A, Fig. 3): C32(7x7) - C32/2 - C32 - C32 - C64/2 - C64 - C128/2 - 1x1 to the
/// hidden channels with a sigmoid; 5x5 kernels, instance norm, ReLU; dropout after each stride-2
/// block. Layer counts from the authors' code (the paper's figure is not in its text).
class EncoderImpl : public torch::nn::Module {
 public:
  explicit EncoderImpl(const NetworkConfig& config);
  /// Images [B,3,H,W] in [0,1] to hidden states [B,c,H/8,W/8] in (0,1).
  torch::Tensor forward(const torch::Tensor& x);

 private:
  torch::nn::Sequential layers_{nullptr};
};
TORCH_MODULE(Encoder);

}  // namespace prospect::model
