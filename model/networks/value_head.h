#pragma once

#include "model/network_config.h"
#include "model/networks/blocks.h"

namespace prospect::model {

/// V(h) (paper §III-A): C32-C64-C128-FC128 and a sigmoid, no normalisation; 4x4 kernels, strides 1,
/// 2, 2 and the dropout from the authors' code. Returns the logit: probability = sigmoid.
class ValueHeadImpl : public torch::nn::Module {
 public:
  explicit ValueHeadImpl(const NetworkConfig& config);
  /// h [B,c,Hh,Wh] to logits [B] of the probability that the task will succeed from here.
  torch::Tensor forward(const torch::Tensor& h);

 private:
  double dropout_;
  torch::nn::Sequential conv_{nullptr};
  torch::nn::Linear dense_{nullptr}, out_{nullptr};
};
TORCH_MODULE(ValueHead);

}  // namespace prospect::model
