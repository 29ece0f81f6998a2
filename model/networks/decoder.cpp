#include "model/networks/decoder.h"

namespace prospect::model {

DecoderImpl::DecoderImpl(const NetworkConfig& config) {
  const BlockOptions plain{Activation::kRelu, true, 0.0};
  const BlockOptions drop{Activation::kRelu, true, config.dropout};
  const BlockOptions out{Activation::kSigmoid, false, 0.0};
  layers_ = register_module(
      "layers", torch::nn::Sequential(ConvBlock(config.hidden_channels, 128, 1, 1, plain),
                                      UpBlock(128, 64, drop), ConvBlock(64, 64, 5, 1, plain),
                                      UpBlock(64, 32, drop), ConvBlock(32, 32, 5, 1, plain),
                                      UpBlock(32, 32, drop), ConvBlock(32, 32, 5, 1, plain),
                                      ConvBlock(32, 3, 1, 1, out)));
  InitialiseGlorot(this);
}

torch::Tensor DecoderImpl::forward(const torch::Tensor& h) { return layers_->forward(h); }

}  // namespace prospect::model
