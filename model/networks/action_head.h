#pragma once

#include "model/network_config.h"
#include "model/networks/blocks.h"

namespace prospect::model {

/// The one shape of Q(h0, h, a, a'), p(a' | h0, h, a) and f(h0, h, a) (paper §III-A): a convolution
/// on each of h and h0, the action concatenated, C64-C64-FC256-FC128, sigmoid outputs; no
/// normalisation. Three separate networks of this class: Q and p with one output an action, f with
/// one. `heads = costar` is the authors' code instead: 4x4 input convolutions, the action again
/// before the dense layers, 128-128.
class ActionHeadImpl : public torch::nn::Module {
 public:
  ActionHeadImpl(const NetworkConfig& config, int outputs);
  /// h0, h [B,c,Hh,Wh]; action [B] int64 in 0..num_actions (num_actions = none yet). Logits
  /// [B,outputs].
  torch::Tensor forward(const torch::Tensor& h0, const torch::Tensor& h,
                        const torch::Tensor& action);

 private:
  bool costar_;
  int num_actions_;
  double dropout_;
  ConvBlock from_h_{nullptr}, from_h0_{nullptr}, conv1_{nullptr}, conv2_{nullptr};
  torch::nn::Linear dense1_{nullptr}, dense2_{nullptr}, out_{nullptr};
};
TORCH_MODULE(ActionHead);

}  // namespace prospect::model
