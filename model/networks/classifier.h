#pragma once

#include "model/network_config.h"
#include "model/networks/blocks.h"

namespace prospect::model {

/// C(x): which action a goal image is the goal of. The paper uses it in the loss (lambda C) and as
/// a measure but does not say its layers; these are the authors': C32(7x7) - C32/2 - C32 - C32 -
/// C64/2 - C64 - C128/2 - C128 - C128/2, dropout, FC1024, dropout, one logit an action; LeakyReLU
/// 0.2, instance norm.
class ClassifierImpl : public torch::nn::Module {
 public:
  explicit ClassifierImpl(const NetworkConfig& config);
  /// Images [B,3,H,W] in [0,1] to logits [B,num_actions] (softmax over actions).
  torch::Tensor forward(const torch::Tensor& x);

  /// The two halves of forward: to the map [B,kMapChannels,H/8,W/8] behind the third stride, and
  /// on.
  torch::Tensor Map(const torch::Tensor& x);
  torch::Tensor Judge(const torch::Tensor& map);
  static constexpr int kMapChannels = 128;

 private:
  double dropout_;
  torch::nn::Sequential conv_{nullptr};
  torch::nn::Linear dense_{nullptr}, out_{nullptr};
};
TORCH_MODULE(Classifier);

}  // namespace prospect::model
