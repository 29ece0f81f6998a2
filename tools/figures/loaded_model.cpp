#include "tools/figures/loaded_model.h"

#include <torch/torch.h>

#include <nlohmann/json.hpp>

#include "model/networks/action_head.h"
#include "model/networks/decoder.h"
#include "model/networks/light.h"
#include "model/weights.h"

namespace prospect::figures {

namespace {

model::NetworkConfig ConfigOf(const model::WeightsFile& file, const std::string& path) {
  try {
    return file.metadata.at("network").get<model::NetworkConfig>();
  } catch (const std::exception& error) {
    throw model::WeightsError(path + ": its network configuration is not understood (" +
                              error.what() + ")");
  }
}

torch::Tensor State(const model::NetworkConfig& c, const model::Hidden& h) {
  return torch::from_blob(const_cast<float*>(h.data()),
                          {1, c.hidden_channels, c.hidden_height(), c.hidden_width()});
}

torch::Tensor ToTensor(const sim::Image& image) {
  const torch::Tensor raw = torch::from_blob(const_cast<std::uint8_t*>(image.rgb.data()),
                                             {1, image.height, image.width, 3}, torch::kUInt8);
  return raw.permute({0, 3, 1, 2}).contiguous().to(torch::kFloat).div_(255.0F);
}

sim::Image ToImage(const torch::Tensor& x) {
  const torch::Tensor bytes =
      x[0].permute({1, 2, 0}).mul(255.0F).round().clamp(0, 255).to(torch::kUInt8).contiguous();
  sim::Image image{static_cast<int>(bytes.size(1)), static_cast<int>(bytes.size(0)), {}};
  image.rgb.assign(bytes.data_ptr<std::uint8_t>(), bytes.data_ptr<std::uint8_t>() + bytes.numel());
  return image;
}

Painter MakePainter(const model::WeightsFile& file, const std::string& path) {
  const model::NetworkConfig config = ConfigOf(file, path);
  model::Decoder decoder(config);
  model::LoadModule(file, path, "decoder", decoder.ptr().get());
  decoder->eval();
  return [config, decoder](const sim::Image& seen, const model::Hidden& start,
                           const std::vector<model::Hidden>& states) mutable {
    const c10::InferenceMode inference;
    const torch::Tensor gain =
        model::LightGain(ToTensor(seen), decoder->forward(State(config, start)));
    std::vector<sim::Image> pictures;
    for (const model::Hidden& state : states) {
      pictures.push_back(ToImage(decoder->forward(State(config, state)) * gain));
    }
    return pictures;
  };
}

DoneHead MakeDoneHead(const model::WeightsFile& file, const std::string& path) {
  const model::NetworkConfig config = ConfigOf(file, path);
  model::ActionHead f(config, 1);
  model::LoadModule(file, path, "f", f.ptr().get());
  f->eval();
  return [config, f](const model::Hidden& h0, const model::Hidden& h, int action) mutable {
    const c10::InferenceMode inference;
    const torch::Tensor a = torch::full({1}, action, torch::kLong);
    return torch::sigmoid(f->forward(State(config, h0), State(config, h), a)).item<float>();
  };
}

}  // namespace

LoadedModel LoadWeights(const std::string& path, int threads) {
  LoadedModel loaded;
  loaded.engine = model::LoadTorchEngine(path, threads);
  const model::WeightsFile file = model::ReadWeights(path);
  loaded.paint = MakePainter(file, path);
  if (loaded.engine->info().judges) loaded.done = MakeDoneHead(file, path);
  return loaded;
}

}  // namespace prospect::figures
