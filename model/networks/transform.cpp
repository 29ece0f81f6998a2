#include "model/networks/transform.h"

namespace prospect::model {
namespace {
constexpr int kWidth = 64;  // channels of every inner layer
}

TransformImpl::TransformImpl(const NetworkConfig& config) : config_(config) {
  const BlockOptions plain{Activation::kRelu, true, 0.0};
  const BlockOptions drop{Activation::kRelu, true, config.dropout_of_transform()};
  const int stages = 1 + config.transform_extra_stages;
  const int cells = (config.hidden_height() >> stages) * (config.hidden_width() >> stages);
  from_h_ = register_module("from_h", ConvBlock(config.hidden_channels, kWidth, 1, 1, plain));
  from_h0_ = register_module("from_h0", ConvBlock(config.hidden_channels, kWidth, 1, 1, plain));
  merge_ = register_module("merge", ConvBlock(2 * kWidth, kWidth, 5, 1, drop));
  action_ = register_module("action", torch::nn::Linear(config.num_actions, kWidth));
  action_norm_ = register_module("action_norm", VectorNorm());
  with_action_ = register_module("with_action", ConvBlock(2 * kWidth, kWidth, 5, 1, plain));
  if (config.bottleneck == "strided") {
    strided_ = register_module("strided", ConvBlock(kWidth, kWidth, 5, 2, plain));
    small_ = register_module("small", ConvBlock(kWidth, kWidth, 5, 1, drop));
  } else {
    dense_ = register_module("dense", torch::nn::Linear(3 * kWidth, cells * kWidth));
  }
  down_ = register_module("down", torch::nn::ModuleList());
  up_ = register_module("up", torch::nn::ModuleList());
  join_ = register_module("join", torch::nn::ModuleList());
  for (int i = 1; i < stages; ++i) down_->push_back(ConvBlock(kWidth, kWidth, 5, 2, drop));
  for (int i = 0; i < stages; ++i) {
    up_->push_back(UpBlock(kWidth, kWidth, drop));
    join_->push_back(ConvBlock((config.skip ? 2 : 1) * kWidth, kWidth, 5, 1, drop));
  }
  const BlockOptions last{Activation::kSigmoid, false, 0.0};
  out_ = register_module("out", ConvBlock(kWidth, config.hidden_channels, 1, 1, last));
  InitialiseGlorot(this);
}

torch::Tensor TransformImpl::Bottleneck(const torch::Tensor& x, const torch::Tensor& y) {
  const int stages = 1 + config_.transform_extra_stages;
  const torch::Tensor tiled = Tile(y, x.size(2), x.size(3));
  const torch::Tensor features = with_action_->forward(torch::cat({x, tiled}, 1));
  if (strided_) return small_->forward(strided_->forward(features));
  const torch::Tensor points = SpatialSoftArgmax(features);
  torch::Tensor z = torch::relu(dense_->forward(torch::cat({points, y}, 1)));
  z = Dropout(z, config_.dropout_of_transform(), is_training());
  return z.view({-1, kWidth, config_.hidden_height() >> stages, config_.hidden_width() >> stages});
}

torch::Tensor TransformImpl::forward(const torch::Tensor& h0, const torch::Tensor& h,
                                     const torch::Tensor& action) {
  const torch::Tensor y =
      Activate(action_norm_->forward(action_->forward(OneHot(action, config_.num_actions))),
               ActivationOf(config_.activation));
  std::vector<torch::Tensor> skips;
  skips.push_back(merge_->forward(torch::cat({from_h_->forward(h), from_h0_->forward(h0)}, 1)));
  for (const auto& down : *down_) skips.push_back(down->as<ConvBlock>()->forward(skips.back()));
  torch::Tensor z = Bottleneck(skips.back(), y);
  for (std::size_t i = 0; i < up_->size(); ++i) {
    z = up_[i]->as<UpBlock>()->forward(z);
    if (config_.skip) z = torch::cat({z, skips.back()}, 1);
    skips.pop_back();
    z = join_[i]->as<ConvBlock>()->forward(z);
  }
  return out_->forward(z);
}

}  // namespace prospect::model
