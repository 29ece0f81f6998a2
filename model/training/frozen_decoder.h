#pragma once

#include <torch/torch.h>

#include "model/inference/picture_networks.h"
#include "model/networks/decoder.h"

namespace prospect::model {

/// f_dec as inference runs it (model/inference/), for pictures that no gradient passes through:
/// three times as fast as libtorch, and the same bits whatever else is in a batch. Keeps the
/// weights that `decoder` had when it was made. Thread-safe.
class FrozenDecoder {
 public:
  FrozenDecoder(const Decoder& decoder, const NetworkConfig& config);

  /// Hidden states [B,C,h,w] on the CPU to pictures [B,3,H,W].
  torch::Tensor operator()(const torch::Tensor& h) const;

 private:
  NetworkConfig config_;
  inference::Decoder decoder_;
};

}  // namespace prospect::model
