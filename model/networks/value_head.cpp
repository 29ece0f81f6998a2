#include "model/networks/value_head.h"

namespace prospect::model {

ValueHeadImpl::ValueHeadImpl(const NetworkConfig& config) : dropout_(config.head_dropout) {
  const BlockOptions plain{Activation::kRelu, false, 0.0};
  const int cells = (config.hidden_height() / 4) * (config.hidden_width() / 4);
  conv_ = register_module(
      "conv",
      torch::nn::Sequential(ConvBlock(config.hidden_channels, 32, 4, 1, plain),
                            ConvBlock(32, 64, 4, 2, plain), ConvBlock(64, 128, 4, 2, plain)));
  dense_ = register_module("dense", torch::nn::Linear(128 * cells, 128));
  out_ = register_module("out", torch::nn::Linear(128, 1));
  InitialiseGlorot(this);
}

torch::Tensor ValueHeadImpl::forward(const torch::Tensor& h) {
  torch::Tensor x = Dropout(conv_->forward(h).flatten(1), dropout_, is_training());
  x = torch::relu(dense_->forward(x));
  return out_->forward(x).squeeze(1);
}

}  // namespace prospect::model
