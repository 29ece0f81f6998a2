#include "model/inference/judges.h"

#include <algorithm>

namespace prospect::model::inference {
namespace {

constexpr int kRead = 32;     // channels that are read from a state
constexpr int kCommon = 64;   // channels of the common convolutions
constexpr int kNarrow = 128;  // of the last dense layer

/// The states of rows, one after the other.
const float* Gather(const StateRow* rows, int count, std::size_t size, Arena& arena) {
  float* const states = arena.Take(static_cast<std::size_t>(count) * size);
  for (int i = 0; i < count; ++i) std::copy_n(rows[i].h, size, states + i * size);
  return states;
}

}  // namespace

ActionHead::ActionHead(const Kernels& kernels, const TensorReader& reader, const std::string& name,
                       const NetworkConfig& config, int outputs)
    : kernels_(kernels) {
  const bool costar = config.heads == "costar";
  const int kernel = costar ? 4 : 1, wide = costar ? kNarrow : 256;
  const Grid grid{config.hidden_height(), config.hidden_width()};
  const auto from = [&](const char* which) {
    return ReadBiasedBlock(reader, name + which, config.hidden_channels, kRead, kernel);
  };
  from_h_.emplace(kernels, grid, 1, from(".from_h"), Activation::kRelu);
  from_h0_.emplace(kernels, grid, 1, from(".from_h0"), Activation::kRelu);
  const BlockTensors conv1 =
      ReadBiasedBlock(reader, name + ".conv1", 2 * kRead + config.num_actions, kCommon, 4);
  conv1_ = MakeConvolution(kernels, grid, 2, conv1.convolution.Inputs(0, kRead));
  conv1_root_ = MakeConvolution(kernels, grid, 2, conv1.convolution.Inputs(kRead, kRead));
  conv2_.emplace(kernels, conv1_->out_grid(), 2,
                 ReadBiasedBlock(reader, name + ".conv2", kCommon, kCommon, 4), Activation::kRelu);
  ReadActions(reader, name, conv1, config);
  dense2_.emplace(kernels, reader, name + ".dense2", wide, 1, kNarrow);
  out_.emplace(kernels, reader, name + ".out", kNarrow, 1, outputs);
}

void ActionHead::ReadActions(const TensorReader& reader, const std::string& name,
                             const BlockTensors& conv1, const NetworkConfig& config) {
  const int none = config.num_actions;
  const std::vector<float> bias = Repeated(conv1.bias, conv1_->out_grid().pixels());
  for (int a = 0; a <= none; ++a) {
    conv1_base_.push_back(bias);
    if (a == none) break;
    const std::vector<float> told =
        ConvolveConstant(conv1_->in_grid(), 2, conv1.convolution.Inputs(2 * kRead + a, 1), {1.0F});
    for (std::size_t i = 0; i < told.size(); ++i) conv1_base_.back()[i] += told[i];
  }
  const bool costar = config.heads == "costar";
  const int pixels = conv2_->convolution().out_grid().pixels(), flat = kCommon * pixels;
  const int in = flat + (costar ? none : 0), wide = costar ? kNarrow : 256;
  const std::vector<float> read = reader.Read(name + ".dense1.weight", {wide, in});
  dense1_base_.assign(static_cast<std::size_t>(none) + 1,
                      reader.Read(name + ".dense1.bias", {wide}));
  std::vector<float> states;
  for (int o = 0; o < wide; ++o) {
    const auto row = read.begin() + std::ptrdiff_t{o} * in;
    states.insert(states.end(), row, row + flat);
    for (int a = 0; a < in - flat; ++a) dense1_base_[a][o] += row[flat + a];
  }
  dense1_.emplace(kernels_, flat, wide, InputMajor(states, wide, kCommon, pixels));
}

void ActionHead::FoldRoot(const float* h0, float* root, Arena& arena) const {
  const Arena::Scope scope(arena);
  float* const features = arena.Take(from_h0_->convolution().out_size());
  from_h0_->Run(h0, 1, features, arena);
  conv1_root_->Run(features, 1, root, arena);
}

void ActionHead::Run(const StateRow* rows, int count, float* answers, Arena& arena) const {
  const Arena::Scope scope(arena);
  const auto take = [&](std::size_t size) {
    return arena.Take(static_cast<std::size_t>(count) * size);
  };
  const float* const states = Gather(rows, count, from_h_->convolution().in_size(), arena);
  float* const features = take(from_h_->convolution().out_size());
  from_h_->Run(states, count, features, arena);
  float* const common = take(conv1_->out_size());
  conv1_->Run(features, count, common, arena);
  for (int i = 0; i < count; ++i) {
    kernels_.add(common + i * conv1_->out_size(), conv1_->out_size(), rows[i].root,
                 conv1_base_[static_cast<std::size_t>(rows[i].action)].data(), Activation::kRelu);
  }
  float* const flat = take(static_cast<std::size_t>(dense1_->inputs()));
  conv2_->Run(common, count, flat, arena);
  const auto wide_size = static_cast<std::size_t>(dense1_->outputs());
  float* const wide = take(wide_size);
  MultiplyRows(kernels_, *dense1_, flat, count, wide, arena);
  for (int i = 0; i < count; ++i) {
    kernels_.add(wide + i * wide_size, wide_size,
                 dense1_base_[static_cast<std::size_t>(rows[i].action)].data(), nullptr,
                 Activation::kRelu);
  }
  float* const narrow = take(kNarrow);
  dense2_->Run(wide, count, narrow, Activation::kRelu, arena);
  out_->Run(narrow, count, answers, Activation::kNone, arena);
  kernels_.sigmoid(answers, static_cast<std::size_t>(count) * out_->outputs());
}

ValueHead::ValueHead(const Kernels& kernels, const TensorReader& reader,
                     const NetworkConfig& config)
    : kernels_(kernels) {
  const Grid grid{config.hidden_height(), config.hidden_width()};
  const auto block = [&](int i, Grid in, int stride, int from, int to) {
    return BiasedBlock(kernels, in, stride,
                       ReadBiasedBlock(reader, "value.conv." + std::to_string(i), from, to, 4),
                       Activation::kRelu);
  };
  conv0_.emplace(block(0, grid, 1, config.hidden_channels, 32));
  conv1_.emplace(block(1, conv0_->convolution().out_grid(), 2, 32, 64));
  conv2_.emplace(block(2, conv1_->convolution().out_grid(), 2, 64, 128));
  dense_.emplace(kernels, reader, "value.dense", 128, conv2_->convolution().out_grid().pixels(),
                 kNarrow);
  out_.emplace(kernels, reader, "value.out", kNarrow, 1, 1);
}

void ValueHead::Run(const float* states, int count, float* answers, Arena& arena) const {
  const Arena::Scope scope(arena);
  const float* x = states;
  for (const BiasedBlock* block : {&*conv0_, &*conv1_, &*conv2_}) {
    float* const next =
        arena.Take(static_cast<std::size_t>(count) * block->convolution().out_size());
    block->Run(x, count, next, arena);
    x = next;
  }
  float* const narrow = arena.Take(static_cast<std::size_t>(count) * kNarrow);
  dense_->Run(x, count, narrow, Activation::kRelu, arena);
  out_->Run(narrow, count, answers, Activation::kNone, arena);
  kernels_.sigmoid(answers, static_cast<std::size_t>(count));
}

}  // namespace prospect::model::inference
