#pragma once

#include "model/network_config.h"
#include "model/networks/blocks.h"

namespace prospect::model {

/// The judge of the two GAN variants: whether pictures x1 and x2 with the action a2 between them
/// are imagined. The paper names the losses (Isola et al. 2017; Arjovsky et al. 2017) and not the
/// layers; these are the authors': C64 (4x4) on each picture, summed, the action through a dense
/// layer added, C64/2 - C128/2 - C256/2 (4x4), LeakyReLU 0.2, dropout, no normalisation. `patches`:
/// a 1x1 convolution and a sigmoid judge every patch, and their mean is the verdict, 1 for
/// imagined. Otherwise a dense layer scores the whole, without bound.
class DiscriminatorImpl : public torch::nn::Module {
 public:
  DiscriminatorImpl(const NetworkConfig& config, bool patches);

  enum class Learns { kYes, kNo };
  /// Pictures [B,3,H,W] in [0,1], actions [B] int64, to verdicts [B]. kNo: no gradient reaches the
  /// judge's own weights, only the pictures.
  torch::Tensor forward(const torch::Tensor& x1, const torch::Tensor& x2,
                        const torch::Tensor& action, Learns learns);

  /// Cuts every weight to [-limit, limit].
  void Clip(double limit);

 private:
  torch::Tensor Convolve(const torch::nn::Conv2d& layer, const torch::Tensor& x, Learns learns);
  torch::Tensor Finish(const torch::Tensor& x);

  bool patches_;
  int num_actions_;
  double dropout_;
  torch::nn::Conv2d picture_{nullptr}, conv1_{nullptr}, conv2_{nullptr}, conv3_{nullptr},
      verdict_{nullptr};
  torch::nn::Linear action_{nullptr}, score_{nullptr};
};
TORCH_MODULE(Discriminator);

}  // namespace prospect::model
