#include "model/networks/action_head.h"

namespace prospect::model {

ActionHeadImpl::ActionHeadImpl(const NetworkConfig& config, int outputs)
    : costar_(config.heads == "costar"),
      num_actions_(config.num_actions),
      dropout_(config.head_dropout) {
  const BlockOptions plain{Activation::kRelu, false, 0.0};
  const int kernel = costar_ ? 4 : 1;
  const int flat = 64 * (config.hidden_height() / 4) * (config.hidden_width() / 4);
  const int extra = costar_ ? num_actions_ : 0;
  const int wide = costar_ ? 128 : 256;
  from_h_ = register_module("from_h", ConvBlock(config.hidden_channels, 32, kernel, 1, plain));
  from_h0_ = register_module("from_h0", ConvBlock(config.hidden_channels, 32, kernel, 1, plain));
  conv1_ = register_module("conv1", ConvBlock(64 + num_actions_, 64, 4, 2, plain));
  conv2_ = register_module("conv2", ConvBlock(64, 64, 4, 2, plain));
  dense1_ = register_module("dense1", torch::nn::Linear(flat + extra, wide));
  dense2_ = register_module("dense2", torch::nn::Linear(wide, 128));
  out_ = register_module("out", torch::nn::Linear(128, outputs));
  InitialiseGlorot(this);
}

torch::Tensor ActionHeadImpl::forward(const torch::Tensor& h0, const torch::Tensor& h,
                                      const torch::Tensor& action) {
  const torch::Tensor a = OneHot(action, num_actions_);
  torch::Tensor x =
      torch::cat({from_h_->forward(h), from_h0_->forward(h0), Tile(a, h.size(2), h.size(3))}, 1);
  x = conv2_->forward(conv1_->forward(x)).flatten(1);
  x = Dropout(x, dropout_, is_training());
  if (costar_) x = torch::cat({x, a}, 1);
  x = Dropout(torch::relu(dense1_->forward(x)), dropout_, is_training());
  x = Dropout(torch::relu(dense2_->forward(x)), dropout_, is_training());
  return out_->forward(x);
}

}  // namespace prospect::model
