#include "model/networks/classifier.h"

namespace prospect::model {
namespace {
constexpr std::size_t kMapLayers = 7;  // of the convolutions, up to the third stride
}

ClassifierImpl::ClassifierImpl(const NetworkConfig& config) : dropout_(config.head_dropout) {
  const BlockOptions plain{Activation::kLeakyRelu, true, 0.0};
  const BlockOptions drop{Activation::kLeakyRelu, true, config.dropout};
  const int cells = (config.image_height / 16) * (config.image_width / 16);
  conv_ = register_module(
      "conv", torch::nn::Sequential(ConvBlock(3, 32, 7, 1, plain), ConvBlock(32, 32, 5, 2, drop),
                                    ConvBlock(32, 32, 5, 1, plain), ConvBlock(32, 32, 5, 1, plain),
                                    ConvBlock(32, 64, 5, 2, drop), ConvBlock(64, 64, 5, 1, plain),
                                    ConvBlock(64, kMapChannels, 5, 2, drop),
                                    ConvBlock(kMapChannels, 128, 5, 1, plain),
                                    ConvBlock(128, 128, 5, 2, plain)));
  dense_ = register_module("dense", torch::nn::Linear(128 * cells, 1024));
  out_ = register_module("out", torch::nn::Linear(1024, config.num_actions));
  InitialiseGlorot(this);
}

torch::Tensor ClassifierImpl::forward(const torch::Tensor& x) { return Judge(Map(x)); }

torch::Tensor ClassifierImpl::Map(const torch::Tensor& x) {
  torch::Tensor y = x;
  for (std::size_t i = 0; i < kMapLayers; ++i) y = conv_[i]->as<ConvBlock>()->forward(y);
  return y;
}

torch::Tensor ClassifierImpl::Judge(const torch::Tensor& map) {
  torch::Tensor y = map;
  for (std::size_t i = kMapLayers; i < conv_->size(); ++i)
    y = conv_[i]->as<ConvBlock>()->forward(y);
  y = Dropout(y.flatten(1), dropout_, is_training());
  y = Activate(dense_->forward(y), Activation::kLeakyRelu);
  return out_->forward(Dropout(y, dropout_, is_training()));
}

}  // namespace prospect::model
