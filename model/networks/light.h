#pragma once

#include "model/networks/libtorch.h"

namespace prospect::model {

/// Factor [B,1,1,1] that brings the light of `decoded` pictures [B,3,H,W] to that of the `seen`
/// ones, by least squares. The encoder normalises its features, so how bright a scene is does not
/// reach the hidden state; light does not change within an episode and is carried past the
/// networks. No gradient.
torch::Tensor LightGain(const torch::Tensor& seen, const torch::Tensor& decoded);

/// The picture of an imagined state [1,3,H,W]: the decoded one, in the light of the picture that
/// was seen where imagination began.
/// @param seen what the camera saw; @param decoded_start its decoded encoding; @param decoded the
/// decoded imagined state
torch::Tensor RelightPicture(const torch::Tensor& seen, const torch::Tensor& decoded_start,
                             const torch::Tensor& decoded);

/// The same where decoding differs from decoding that beginning, and a pixel around; elsewhere what
/// was seen. Beyond the paper: what no action changes need not be painted anew. It pays where
/// little changes (navigation), not where a shadow moves over the whole picture (stacking).
torch::Tensor ComposePicture(const torch::Tensor& seen, const torch::Tensor& decoded_start,
                             const torch::Tensor& decoded);

/// ComposePicture if `compose`, else RelightPicture.
torch::Tensor ImaginedPicture(const torch::Tensor& seen, const torch::Tensor& decoded_start,
                              const torch::Tensor& decoded, bool compose);

}  // namespace prospect::model
