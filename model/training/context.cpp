#include "model/training/context.h"

#include <stdexcept>

namespace prospect::model {

torch::Tensor PixelWeights(const torch::Tensor& x, const torch::Tensor& mean_picture,
                           double focus) {
  const torch::Tensor difference = (x - mean_picture).abs().amax(1, /*keepdim=*/true);
  return ((difference - 0.08) / 0.1).clamp(0.0, 1.0) * focus + 1.0;
}

torch::Device DeviceNamed(const std::string& name) {
  if (name == "cuda" && !torch::cuda::is_available()) {
    throw std::invalid_argument(
        "device 'cuda': libtorch finds no GPU here; take --device cpu, or a build with CUDA's "
        "libtorch on a machine that has one");
  }
  return torch::Device(name);
}

torch::Tensor ActionTensor(const std::vector<int>& actions, const torch::Device& device) {
  torch::Tensor tensor = torch::empty({static_cast<int64_t>(actions.size())}, torch::kLong);
  for (std::size_t i = 0; i < actions.size(); ++i) tensor.data_ptr<int64_t>()[i] = actions[i];
  return tensor.to(device);
}

torch::Tensor FloatTensor(const std::vector<float>& values, const torch::Device& device) {
  torch::Tensor tensor = torch::empty({static_cast<int64_t>(values.size())});
  std::copy(values.begin(), values.end(), tensor.data_ptr<float>());
  return tensor.to(device);
}

}  // namespace prospect::model
