#pragma once

#include "model/network_config.h"
#include "model/networks/blocks.h"

namespace prospect::model {

/// f_dec (paper §III-A, Fig. 3), the encoder's mirror: 1x1 to 128 - up 64 - C64 - up 32 - C32 - up
/// 32 - C32 - 1x1 to 3 with a sigmoid; instance norm, ReLU, dropout after each doubling.
class DecoderImpl : public torch::nn::Module {
 public:
  explicit DecoderImpl(const NetworkConfig& config);
  /// Hidden states [B,c,H/8,W/8] to images [B,3,H,W] in (0,1).
  torch::Tensor forward(const torch::Tensor& h);

 private:
  torch::nn::Sequential layers_{nullptr};
};
TORCH_MODULE(Decoder);

}  // namespace prospect::model
