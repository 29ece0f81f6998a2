#include "model/inference/layers.h"

#include <utility>

namespace prospect::model::inference {

void Norm::Run(const Kernels& kernels, float* map, Grid grid, const AddedMap& added,
               const float* modulation) const {
  kernels.normalise(map, grid.pixels(), static_cast<int>(scale.size()), added,
                    {scale.data(), shift.data(), modulation}, activation);
}

BlockTensors ReadBiasedBlock(const TensorReader& reader, const std::string& name, int in, int out,
                             int kernel) {
  BlockTensors block;
  block.convolution = reader.ReadConvolution(name + ".conv", in, out, kernel);
  block.bias = reader.Read(name + ".conv.bias", {out});
  return block;
}

BlockTensors ReadNormedBlock(const TensorReader& reader, const std::string& name, int in, int out,
                             int kernel, Activation activation) {
  BlockTensors block = ReadBiasedBlock(reader, name, in, out, kernel);
  block.norm = {reader.Read(name + ".norm.scale", {out}), reader.Read(name + ".norm.shift", {out}),
                activation};
  return block;
}

BlockTensors ReadDoublingBlock(const TensorReader& reader, const std::string& name, int in,
                               int out) {
  BlockTensors block = ReadBiasedBlock(reader, name, in, 4 * out, 3);
  block.norm = {reader.Read(name + ".norm.scale", {out}), reader.Read(name + ".norm.shift", {out}),
                Activation::kRelu};
  return block;
}

NormedBlock::NormedBlock(const Kernels& kernels, Grid in, int stride, BlockTensors tensors)
    : kernels_(kernels),
      convolution_(MakeConvolution(kernels, in, stride, tensors.convolution)),
      norm_(std::move(tensors.norm)) {}

NormedBlock::NormedBlock(const Kernels& kernels, Grid in, BlockTensors tensors, Doubling)
    : kernels_(kernels),
      convolution_(MakeDoubling(kernels, in, tensors.convolution)),
      norm_(std::move(tensors.norm)) {
  // A pixel's bias depends on which of the four outputs it came from: no norm takes that away.
  const std::size_t channels = norm_.scale.size();
  const Grid grid = convolution_->out_grid();
  for (std::size_t phase = 0; phase < 4; ++phase) {
    for (std::size_t c = 0; c < channels; ++c) phase_bias_.push_back(tensors.bias[c * 4 + phase]);
  }
  for (int p = 0; p < grid.pixels(); ++p)
    phase_of_pixel_.push_back(p / grid.width % 2 * 2 + p % grid.width % 2);
}

void NormedBlock::Convolve(const float* in, int maps, float* out, Arena& arena) const {
  convolution_->Run(in, maps, out, arena);
}

void NormedBlock::Normalise(float* map, const AddedMap& added, const float* modulation) const {
  const AddedMap bias{phase_bias_.data(), phase_of_pixel_.data()};
  const bool doubles = !phase_bias_.empty();
  norm_.Run(kernels_, map, convolution_->out_grid(), doubles ? bias : added, modulation);
}

void NormedBlock::Run(const float* in, int maps, float* out, Arena& arena) const {
  Convolve(in, maps, out, arena);
  for (int map = 0; map < maps; ++map, out += convolution_->out_size()) Normalise(out, {}, nullptr);
}

BiasedBlock::BiasedBlock(const Kernels& kernels, Grid in, int stride, const BlockTensors& tensors,
                         Activation activation)
    : kernels_(kernels),
      convolution_(MakeConvolution(kernels, in, stride, tensors.convolution)),
      bias_(Repeated(tensors.bias, convolution_->out_grid().pixels())),
      activation_(activation) {}

void BiasedBlock::Run(const float* in, int maps, float* out, Arena& arena) const {
  convolution_->Run(in, maps, out, arena);
  for (int map = 0; map < maps; ++map, out += bias_.size())
    kernels_.add(out, bias_.size(), bias_.data(), nullptr, activation_);
}

std::vector<float> Repeated(const std::vector<float>& values, int times) {
  std::vector<float> all;
  all.reserve(values.size() * static_cast<std::size_t>(times));
  for (int i = 0; i < times; ++i) all.insert(all.end(), values.begin(), values.end());
  return all;
}

Dense::Dense(const Kernels& kernels, int in, const std::vector<float>& weights,
             std::vector<float> bias)
    : kernels_(kernels),
      weights_(kernels, in, static_cast<int>(bias.size()), weights),
      bias_(std::move(bias)) {}

Dense::Dense(const Kernels& kernels, const TensorReader& reader, const std::string& name,
             int channels, int pixels, int out)
    : Dense(kernels, channels * pixels,
            InputMajor(reader.Read(name + ".weight", {out, std::int64_t{channels} * pixels}), out,
                       channels, pixels),
            reader.Read(name + ".bias", {out})) {}

void Dense::Run(const float* in, int rows, float* out, Activation activation, Arena& arena) const {
  MultiplyRows(kernels_, weights_, in, rows, out, arena);
  for (int row = 0; row < rows; ++row, out += bias_.size())
    kernels_.add(out, bias_.size(), bias_.data(), nullptr, activation);
}

std::vector<float> InputMajor(const std::vector<float>& weights, int out, int channels,
                              int pixels) {
  std::vector<float> turned;
  turned.reserve(weights.size());
  for (int p = 0; p < pixels; ++p) {
    for (int c = 0; c < channels; ++c) {
      for (int o = 0; o < out; ++o)
        turned.push_back(weights[(static_cast<std::size_t>(o) * channels + c) * pixels + p]);
    }
  }
  return turned;
}

void ToPixelMajor(const float* from, int channels, int pixels, float* to) {
  for (int p = 0; p < pixels; ++p) {
    for (int c = 0; c < channels; ++c) *to++ = from[c * pixels + p];
  }
}

void ToChannelMajor(const float* from, int channels, int pixels, float* to) {
  for (int c = 0; c < channels; ++c) {
    for (int p = 0; p < pixels; ++p) *to++ = from[p * channels + c];
  }
}

}  // namespace prospect::model::inference
