#include "model/inference/picture_networks.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace prospect::model::inference {
namespace {

/// Runs blocks one after the other over a single map; the last one's output.
const float* RunAll(const std::vector<NormedBlock>& blocks, const float* in, Arena& arena) {
  for (const NormedBlock& block : blocks) {
    float* const out = arena.Take(block.convolution().out_size());
    block.Run(in, 1, out, arena);
    in = out;
  }
  return in;
}

struct Layer {
  int in, out, kernel, stride;
};

/// The first seven layers of the encoder, which are the classifier's, too.
constexpr Layer kReading[] = {{3, 32, 7, 1},  {32, 32, 5, 2}, {32, 32, 5, 1}, {32, 32, 5, 1},
                              {32, 64, 5, 2}, {64, 64, 5, 1}, {64, 128, 5, 2}};

void AddBlock(const Kernels& kernels, const TensorReader& reader, const std::string& list,
              const Layer& layer, Activation activation, Grid* grid,
              std::vector<NormedBlock>* blocks) {
  const std::string name = list + "." + std::to_string(blocks->size());
  blocks->emplace_back(
      kernels, *grid, layer.stride,
      ReadNormedBlock(reader, name, layer.in, layer.out, layer.kernel, activation));
  *grid = blocks->back().convolution().out_grid();
}

}  // namespace

void ToFloats(const std::uint8_t* rgb, std::size_t count, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<float>(rgb[i]) / 255.0F;
}

Encoder::Encoder(const Kernels& kernels, const TensorReader& reader, const NetworkConfig& config)
    : kernels_(kernels) {
  const Activation activation =
      config.activation == "relu" ? Activation::kRelu : Activation::kLeakyRelu;
  Grid grid{config.image_height, config.image_width};
  for (const Layer& layer : kReading)
    AddBlock(kernels, reader, "encoder.layers", layer, activation, &grid, &blocks_);
  out_.emplace(kernels, grid, 1,
               ReadBiasedBlock(reader, "encoder.layers.7", 128, config.hidden_channels, 1),
               Activation::kNone);
}

void Encoder::Run(const float* picture, float* h, Arena& arena) const {
  const Arena::Scope scope(arena);
  out_->Run(RunAll(blocks_, picture, arena), 1, h, arena);
  kernels_.sigmoid(h, out_->convolution().out_size());
}

Decoder::Decoder(const Kernels& kernels, const TensorReader& reader, const NetworkConfig& config)
    : kernels_(kernels) {
  const std::string list = "decoder.layers";
  Grid grid{config.hidden_height(), config.hidden_width()};
  AddBlock(kernels, reader, list, {config.hidden_channels, 128, 1, 1}, Activation::kRelu, &grid,
           &blocks_);
  int from = 128;
  for (const int to : {64, 32, 32}) {
    const std::string name = list + "." + std::to_string(blocks_.size());
    blocks_.emplace_back(kernels, grid, ReadDoublingBlock(reader, name, from, to),
                         NormedBlock::Doubling{});
    grid = blocks_.back().convolution().out_grid();
    AddBlock(kernels, reader, list, {to, to, 5, 1}, Activation::kRelu, &grid, &blocks_);
    from = to;
  }
  out_.emplace(kernels, grid, 1, ReadBiasedBlock(reader, list + ".7", from, 3, 1),
               Activation::kNone);
}

void Decoder::Run(const float* h, float* picture, Arena& arena) const {
  const Arena::Scope scope(arena);
  out_->Run(RunAll(blocks_, h, arena), 1, picture, arena);
  kernels_.sigmoid(picture, out_->convolution().out_size());
}

Classifier::Classifier(const Kernels& kernels, const TensorReader& reader, const std::string& name,
                       const NetworkConfig& config) {
  Grid grid{config.image_height, config.image_width};
  const auto add = [&](const Layer& layer) {
    AddBlock(kernels, reader, name + ".conv", layer, Activation::kLeakyRelu, &grid, &blocks_);
  };
  for (const Layer& layer : kReading) add(layer);
  add({128, 128, 5, 1});
  add({128, 128, 5, 2});
  dense_.emplace(kernels, reader, name + ".dense", 128, grid.pixels(), 1024);
  out_.emplace(kernels, reader, name + ".out", 1024, 1, config.num_actions);
}

std::vector<float> Classifier::Run(const float* picture, Arena& arena) const {
  const Arena::Scope scope(arena);
  float* const wide = arena.Take(static_cast<std::size_t>(dense_->outputs()));
  dense_->Run(RunAll(blocks_, picture, arena), 1, wide, Activation::kLeakyRelu, arena);
  std::vector<float> shares(static_cast<std::size_t>(out_->outputs()));
  out_->Run(wide, 1, shares.data(), Activation::kNone, arena);
  const float most = *std::max_element(shares.begin(), shares.end());
  float sum = 0;
  for (float& share : shares) sum += share = std::exp(share - most);
  for (float& share : shares) share /= sum;
  return shares;
}

}  // namespace prospect::model::inference
