#include "model/training/frozen_decoder.h"

#include <map>
#include <string>

#include "model/weights.h"

namespace prospect::model {
namespace {

inference::Decoder Taken(const Decoder& decoder, const NetworkConfig& config) {
  std::map<std::string, torch::Tensor> tensors;
  CollectTensors("decoder", *decoder, &tensors);
  WeightsFile file;
  for (const auto& [name, tensor] : tensors) file.tensors[name] = ToStored(tensor);
  const std::string path = "the decoder in training";
  return {inference::BestKernels(), {file, path}, config};
}

}  // namespace

FrozenDecoder::FrozenDecoder(const Decoder& decoder, const NetworkConfig& config)
    : config_(config), decoder_(Taken(decoder, config)) {}

torch::Tensor FrozenDecoder::operator()(const torch::Tensor& h) const {
  thread_local inference::Arena arena;
  const inference::Arena::Scope scope(arena);
  const torch::Tensor by_pixel = h.detach().permute({0, 2, 3, 1}).contiguous();
  torch::Tensor pictures =
      torch::empty({h.size(0), config_.image_height, config_.image_width, 3}, h.options());
  for (std::int64_t i = 0; i < h.size(0); ++i) {
    decoder_.Run(by_pixel[i].data_ptr<float>(), pictures[i].data_ptr<float>(), arena);
  }
  return pictures.permute({0, 3, 1, 2});
}

}  // namespace prospect::model
