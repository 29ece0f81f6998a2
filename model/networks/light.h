#pragma once

#include <torch/torch.h>

namespace prospect::model {

/// Factor [B,1,1,1] that brings the light of `decoded` pictures [B,3,H,W] to that of the `seen` ones,
/// by least squares. The encoder normalises its features, so how bright a scene is does not reach
/// the hidden state; light does not change within an episode and is carried past the networks. No
/// gradient.
torch::Tensor LightGain(const torch::Tensor& seen, const torch::Tensor& decoded);

}  // namespace prospect::model
