#pragma once

#include <vector>

#include "model/network_config.h"
#include "model/networks/blocks.h"

namespace prospect::model {

/// T(h0, h, a) to h' (paper §III-A, Fig. 4): the hidden state after carrying out action a from h,
/// where h0 is the hidden state of the problem's first image.
///
/// h and h0 through 1x1 convolutions each (64), merged by C64 (the skip tensor); the action through
/// a dense layer (64), tiled and merged by C64; spatial soft argmax to 128 numbers, the action
/// again, a dense layer to a quarter of the grid x 64; up; the skip tensor; C64; 1x1 with a
/// sigmoid. `bottleneck = strided` is the paper's U-net comparison: a strided and a plain 5x5
/// convolution in the place of soft argmax and dense layer. `transform_extra_stages` adds strided
/// C64 blocks on the way down, with a skip and a doubling each on the way up (the paper's suturing
/// net). Beyond the paper: `transform_action = scale_and_shift` tells every layer of 64 channels
/// the action; `transform_mask` adds a 1x1 convolution whose sigmoid m keeps numbers of h: the
/// result is m h' + (1 - m) h.
class TransformImpl : public torch::nn::Module {
 public:
  explicit TransformImpl(const NetworkConfig& config);
  /// h0, h [B,c,Hh,Wh]; action [B] int64 in 0..num_actions-1. Returns [B,c,Hh,Wh] in (0,1).
  torch::Tensor forward(const torch::Tensor& h0, const torch::Tensor& h,
                        const torch::Tensor& action);
  /// Sets what goes beyond the paper so that it changes next to nothing: weights that were trained
  /// without it give what they gave.
  void NeutraliseExtras();

 private:
  torch::Tensor Bottleneck(const torch::Tensor& x, const torch::Tensor& y);
  /// What the action does to each modulated layer, in the order they are run; undefined tensors
  /// where the configuration has none.
  std::vector<torch::Tensor> Modulations(const torch::Tensor& one_hot);

  NetworkConfig config_;
  ConvBlock from_h_{nullptr}, from_h0_{nullptr}, merge_{nullptr}, with_action_{nullptr};
  torch::nn::ModuleList down_{nullptr}, up_{nullptr}, join_{nullptr};
  torch::nn::Linear action_{nullptr}, dense_{nullptr}, modulation_{nullptr};
  ConvBlock strided_{nullptr}, small_{nullptr};  ///< instead of dense_
  VectorNorm action_norm_{nullptr};
  ConvBlock out_{nullptr}, mask_{nullptr};
};
TORCH_MODULE(Transform);

}  // namespace prospect::model
