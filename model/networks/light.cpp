#include "model/networks/light.h"

namespace prospect::model {

torch::Tensor LightGain(const torch::Tensor& seen, const torch::Tensor& decoded) {
  const torch::Tensor x = decoded.detach();
  return (seen * x).sum({1, 2, 3}, true) / x.square().sum({1, 2, 3}, true).clamp_min(1e-6);
}

}  // namespace prospect::model
