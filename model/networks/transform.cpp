#include "model/networks/transform.h"

namespace prospect::model {
namespace {
constexpr int kWidth = 64;  // channels of every inner layer

/// merge, and each stage's down (but the first), up and join.
int ModulatedLayers(int stages) { return 3 * stages; }
}  // namespace

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
  if (config.transform_mask)
    mask_ = register_module("mask", ConvBlock(kWidth, config.hidden_channels, 1, 1, last));
  if (config.transform_action == "scale_and_shift") {
    modulation_ = register_module(
        "modulation", torch::nn::Linear(config.num_actions, 2 * kWidth * ModulatedLayers(stages)));
  }
  InitialiseGlorot(this);
}

void TransformImpl::NeutraliseExtras() {
  constexpr double kNearlyAll = 4;  // a sigmoid of 0.98 leaves the mask a gradient
  const torch::NoGradGuard no_grad;
  const auto fill = [](torch::nn::Module& module, double bias) {
    for (auto& item : module.named_parameters()) {
      const bool is_bias = item.key().find("bias") != std::string::npos;
      item.value().fill_(is_bias ? bias : 0.0);
    }
  };
  if (modulation_) fill(*modulation_, 0);
  if (mask_) fill(*mask_, kNearlyAll);
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

std::vector<torch::Tensor> TransformImpl::Modulations(const torch::Tensor& one_hot) {
  const int layers = ModulatedLayers(1 + config_.transform_extra_stages);
  if (!modulation_) return std::vector<torch::Tensor>(static_cast<std::size_t>(layers));
  return modulation_->forward(one_hot).chunk(layers, 1);
}

torch::Tensor TransformImpl::forward(const torch::Tensor& h0, const torch::Tensor& h,
                                     const torch::Tensor& action) {
  const torch::Tensor one_hot = OneHot(action, config_.num_actions);
  const torch::Tensor y =
      Activate(action_norm_->forward(action_->forward(one_hot)), ActivationOf(config_.activation));
  const std::vector<torch::Tensor> modulations = Modulations(one_hot);
  auto modulation = modulations.begin();
  std::vector<torch::Tensor> skips;
  skips.push_back(merge_->Modulated(torch::cat({from_h_->forward(h), from_h0_->forward(h0)}, 1),
                                    *modulation++));
  for (const auto& down : *down_)
    skips.push_back(down->as<ConvBlock>()->Modulated(skips.back(), *modulation++));
  torch::Tensor z = Bottleneck(skips.back(), y);
  for (std::size_t i = 0; i < up_->size(); ++i) {
    z = up_[i]->as<UpBlock>()->Modulated(z, *modulation++);
    if (config_.skip) z = torch::cat({z, skips.back()}, 1);
    skips.pop_back();
    z = join_[i]->as<ConvBlock>()->Modulated(z, *modulation++);
  }
  const torch::Tensor fresh = out_->forward(z);
  return mask_ ? h + mask_->forward(z) * (fresh - h) : fresh;
}

}  // namespace prospect::model
