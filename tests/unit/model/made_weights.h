#pragma once

#include <torch/torch.h>

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "model/engine.h"
#include "model/networks/networks.h"
#include "model/weights.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {

/// A weights file of random numbers, biases, scales and modulations among them.
class MadeWeights {
 public:
  explicit MadeWeights(const NetworkConfig& config, bool heads = true,
                       const nlohmann::json& train = nlohmann::json::object()) {
    torch::manual_seed(5);
    const torch::NoGradGuard no_grad;
    const Networks networks(config);
    std::map<std::string, torch::Tensor> tensors;
    for (const auto& [name, module] : networks.named()) {
      if (name == "second_classifier" || (IsHead(name) && !heads)) continue;
      for (auto& item : module->named_parameters()) {
        if (item.value().dim() == 1) item.value().add_(torch::randn_like(item.value()), 0.3);
      }
      CollectTensors(name, *module, &tensors);
    }
    WriteWeights(path, tensors, {{"task", "made"}, {"network", config}, {"train", train}});
  }

  TestFolder folder;
  std::string path = folder / "w.safetensors";
};

inline std::vector<std::uint8_t> Picture(const EngineInfo& info, int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::vector<std::uint8_t> picture(
      static_cast<std::size_t>(info.image_width * info.image_height * 3));
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture[i] = static_cast<std::uint8_t>(
        (i * static_cast<std::size_t>(seed + 3) / 7 + random() % 64) % 256);
  return picture;
}

}  // namespace prospect::model
