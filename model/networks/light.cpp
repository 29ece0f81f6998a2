#include "model/networks/light.h"

namespace prospect::model {

torch::Tensor LightGain(const torch::Tensor& seen, const torch::Tensor& decoded) {
  const torch::Tensor x = decoded.detach();
  return (seen * x).sum({1, 2, 3}, true) / x.square().sum({1, 2, 3}, true).clamp_min(1e-6);
}

torch::Tensor RelightPicture(const torch::Tensor& seen, const torch::Tensor& decoded_start,
                             const torch::Tensor& decoded) {
  return (decoded * LightGain(seen, decoded_start)).clamp(0.0, 1.0);
}

torch::Tensor ComposePicture(const torch::Tensor& seen, const torch::Tensor& decoded_start,
                             const torch::Tensor& decoded) {
  // Chosen on the validation split of navigation: lower ones paint noise of the decoder over what
  // was seen, higher ones leave out what changed.
  constexpr double kSame = 0.16, kOther = 0.28;
  const torch::Tensor gain = LightGain(seen, decoded_start);
  // In the light of what was seen: on what scale the decoder paints is its own affair.
  const torch::Tensor difference = ((decoded - decoded_start) * gain).abs().amax(1, true);
  const torch::Tensor fresh = ((difference - kSame) / (kOther - kSame)).clamp(0.0, 1.0);
  // And what touches it: where the decoder's blurred rim of a thing happens to have the ground's
  // colour, the thing's own rim would stay behind.
  const torch::Tensor touched = torch::max_pool2d(fresh, /*kernel_size=*/3, /*stride=*/1,
                                                  /*padding=*/1);
  const torch::Tensor painted = decoded * gain;
  return (seen + touched * (painted - seen)).clamp(0.0, 1.0);
}

torch::Tensor ImaginedPicture(const torch::Tensor& seen, const torch::Tensor& decoded_start,
                              const torch::Tensor& decoded, bool compose) {
  return compose ? ComposePicture(seen, decoded_start, decoded)
                 : RelightPicture(seen, decoded_start, decoded);
}

}  // namespace prospect::model
