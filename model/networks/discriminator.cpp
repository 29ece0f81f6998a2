#include "model/networks/discriminator.h"

namespace prospect::model {
namespace {

constexpr int kWidth = 64;
constexpr int kKernel = 4;

torch::nn::Conv2d JudgeConv(int in, int out, int stride) {
  // Stride 1 is padded unevenly by hand.
  return torch::nn::Conv2d(
      torch::nn::Conv2dOptions(in, out, kKernel).stride(stride).padding(stride == 2 ? 1 : 0));
}

torch::Tensor Weight(const torch::Tensor& weight, DiscriminatorImpl::Learns learns) {
  return learns == DiscriminatorImpl::Learns::kYes ? weight : weight.detach();
}

torch::Tensor Dense(const torch::nn::Linear& layer, const torch::Tensor& x,
                    DiscriminatorImpl::Learns learns) {
  return torch::linear(x, Weight(layer->weight, learns), Weight(layer->bias, learns));
}

}  // namespace

DiscriminatorImpl::DiscriminatorImpl(const NetworkConfig& config, bool patches)
    : patches_(patches), num_actions_(config.num_actions), dropout_(config.dropout) {
  picture_ = register_module("picture", JudgeConv(3, kWidth, 1));
  action_ = register_module("action", torch::nn::Linear(config.num_actions, kWidth));
  conv1_ = register_module("conv1", JudgeConv(kWidth, kWidth, 2));
  conv2_ = register_module("conv2", JudgeConv(kWidth, 2 * kWidth, 2));
  conv3_ = register_module("conv3", JudgeConv(2 * kWidth, 4 * kWidth, 2));
  if (patches) {
    verdict_ =
        register_module("verdict", torch::nn::Conv2d(torch::nn::Conv2dOptions(4 * kWidth, 1, 1)));
  } else {
    const int cells = (config.image_height / 8) * (config.image_width / 8);
    score_ = register_module("score", torch::nn::Linear(4 * kWidth * cells, 1));
  }
  InitialiseGlorot(this);
}

torch::Tensor DiscriminatorImpl::Convolve(const torch::nn::Conv2d& layer, const torch::Tensor& x,
                                          Learns learns) {
  return torch::conv2d(x, Weight(layer->weight, learns), Weight(layer->bias, learns),
                       layer->options.stride(),
                       c10::get<torch::ExpandingArray<2>>(layer->options.padding()));
}

torch::Tensor DiscriminatorImpl::Finish(const torch::Tensor& x) {
  return Dropout(Activate(x, Activation::kLeakyRelu), dropout_, is_training());
}

torch::Tensor DiscriminatorImpl::forward(const torch::Tensor& x1, const torch::Tensor& x2,
                                         const torch::Tensor& action, Learns learns) {
  const auto look = [&](const torch::Tensor& x) {
    return Finish(Convolve(picture_, torch::constant_pad_nd(x, {1, 2, 1, 2}), learns));
  };
  const torch::Tensor y = Finish(Dense(action_, OneHot(action, num_actions_), learns));
  torch::Tensor z = look(x1) + look(x2) + Tile(y, x1.size(2), x1.size(3));
  for (const torch::nn::Conv2d& layer : {conv1_, conv2_, conv3_}) {
    z = Finish(Convolve(layer, z, learns));
  }
  if (patches_) return torch::sigmoid(Convolve(verdict_, z, learns)).mean({1, 2, 3});
  return Dense(score_, z.flatten(1), learns).squeeze(1);
}

void DiscriminatorImpl::Clip(double limit) {
  const torch::NoGradGuard no_grad;
  for (torch::Tensor& tensor : parameters()) tensor.clamp_(-limit, limit);
}

}  // namespace prospect::model
