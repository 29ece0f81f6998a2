#include "model/networks/light.h"

namespace prospect::model {

torch::Tensor LightGain(const torch::Tensor& seen, const torch::Tensor& decoded) {
  const torch::Tensor x = decoded.detach();
  return (seen * x).sum({1, 2, 3}, true) / x.square().sum({1, 2, 3}, true).clamp_min(1e-6);
}

torch::Tensor ComposePicture(const torch::Tensor& seen, const torch::Tensor& decoded_start,
                             const torch::Tensor& decoded) {
  // A pixel counts as changed from a difference of 0.1 on, as in the scores.
  constexpr double kSame = 0.10, kOther = 0.20;
  const torch::Tensor difference = (decoded - decoded_start).abs().amax(1, true);
  const torch::Tensor fresh = ((difference - kSame) / (kOther - kSame)).clamp(0.0, 1.0);
  const torch::Tensor painted = decoded * LightGain(seen, decoded_start);
  return (seen + fresh * (painted - seen)).clamp(0.0, 1.0);
}

}  // namespace prospect::model
