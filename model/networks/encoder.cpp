#include "model/networks/encoder.h"

namespace prospect::model {

EncoderImpl::EncoderImpl(const NetworkConfig& config) {
  const BlockOptions plain{ActivationOf(config.activation), true, 0.0};
  BlockOptions drop = plain;
  drop.dropout = config.dropout;
  const BlockOptions out{Activation::kSigmoid, false, 0.0};
  layers_ = register_module(
      "layers",
      torch::nn::Sequential(ConvBlock(3, 32, 7, 1, plain), ConvBlock(32, 32, 5, 2, drop),
                            ConvBlock(32, 32, 5, 1, plain), ConvBlock(32, 32, 5, 1, plain),
                            ConvBlock(32, 64, 5, 2, drop), ConvBlock(64, 64, 5, 1, plain),
                            ConvBlock(64, 128, 5, 2, drop),
                            ConvBlock(128, config.hidden_channels, 1, 1, out)));
  InitialiseGlorot(this);
}

torch::Tensor EncoderImpl::forward(const torch::Tensor& x) { return layers_->forward(x); }

}  // namespace prospect::model
