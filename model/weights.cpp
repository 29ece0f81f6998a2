#include "model/weights.h"

#include <cstring>
#include <vector>

namespace prospect::model {

torch::Tensor ToTorch(const StoredTensor& stored) {
  const bool half = stored.type == StoredTensor::Type::kHalf;
  torch::Tensor tensor = torch::empty(stored.shape, half ? torch::kHalf : torch::kFloat);
  if (!stored.bytes.empty())
    std::memcpy(tensor.data_ptr(), stored.bytes.data(), stored.bytes.size());
  return tensor;
}

StoredTensor ToStored(const torch::Tensor& tensor) {
  const torch::Tensor floats = tensor.detach().to(torch::kCPU).to(torch::kFloat).contiguous();
  return {StoredTensor::Type::kFloat, floats.sizes().vec(),
          std::string(static_cast<const char*>(floats.data_ptr()), floats.nbytes())};
}

void WriteWeights(const std::string& path, const std::map<std::string, torch::Tensor>& tensors,
                  const nlohmann::json& metadata) {
  std::map<std::string, StoredTensor> stored;
  for (const auto& [name, tensor] : tensors) stored[name] = ToStored(tensor);
  WriteWeights(path, stored, metadata);
}

void CollectTensors(const std::string& prefix, const torch::nn::Module& module,
                    std::map<std::string, torch::Tensor>* tensors) {
  for (const auto& item : module.named_parameters()) {
    (*tensors)[prefix + "." + item.key()] = item.value().detach();
  }
}

void LoadModule(const WeightsFile& file, const std::string& path, const std::string& prefix,
                torch::nn::Module* module) {
  const torch::NoGradGuard no_grad;
  for (auto& item : module->named_parameters()) {
    const std::vector<float> values =
        NetworkTensor(file, path, prefix + "." + item.key(), item.value().sizes().vec());
    item.value().copy_(torch::tensor(values).view(item.value().sizes()));
  }
}

void LoadModule(const std::string& path, const std::string& prefix, torch::nn::Module* module) {
  LoadModule(ReadWeights(path), path, prefix, module);
}

}  // namespace prospect::model
