#include "model/inference/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace prospect::model::inference {
namespace {

constexpr int kWidth = 64;         // channels of every inner layer
constexpr int kMostStages = 4;     // NetworkConfig::transform_extra_stages and one more
constexpr int kWindow = 5;         // of the inner convolutions
constexpr double kEpsilon = 1e-5;  // of the vector norm
constexpr float kLeakySlope = 0.2F;

/// Which of a window's kinds of lines line i of n is: those near an edge see less of the map.
int KindOfLine(int i, int n) {
  if (n <= kWindow || i < kWindow / 2) return i;
  return std::max(kWindow / 2, i - (n - kWindow));
}

/// Rows `begin` to `end` of libtorch's [out][in], as [in][out].
std::vector<float> DenseInputs(const std::vector<float>& weights, int out, int in, int begin,
                               int end) {
  std::vector<float> some;
  for (int i = begin; i < end; ++i) {
    for (int o = 0; o < out; ++o) some.push_back(weights[static_cast<std::size_t>(o) * in + i]);
  }
  return some;
}

}  // namespace

Transform::Transform(const Kernels& kernels, const TensorReader& reader,
                     const NetworkConfig& config)
    : kernels_(kernels), config_(config), grid_{config.hidden_height(), config.hidden_width()} {
  const int stages = 1 + config.transform_extra_stages;
  deepest_ = {grid_.height >> stages, grid_.width >> stages};
  const auto block = [&](const char* name, int in, int kernel) {
    return ReadNormedBlock(reader, std::string("transform.") + name, in, kWidth, kernel,
                           Activation::kRelu);
  };
  from_h_.emplace(kernels, grid_, 1, block("from_h", config.hidden_channels, 1));
  from_h0_.emplace(kernels, grid_, 1, block("from_h0", config.hidden_channels, 1));
  BlockTensors merge = block("merge", 2 * kWidth, kWindow);
  merge_root_ = MakeConvolution(kernels, grid_, 1, merge.convolution.Inputs(kWidth, kWidth));
  merge.convolution = merge.convolution.Inputs(0, kWidth);
  merge_.emplace(kernels, grid_, 1, std::move(merge));
  ReadActions(reader);
  BlockTensors with_action = block("with_action", 2 * kWidth, kWindow);
  ReadStages(reader);
  AddTiled(with_action.convolution.Inputs(kWidth, kWidth));
  with_action.convolution = with_action.convolution.Inputs(0, kWidth);
  with_action_.emplace(kernels, Grid{2 * deepest_.height, 2 * deepest_.width}, 1,
                       std::move(with_action));
  ReadBottleneck(reader);
  BlockTensors out = ReadBiasedBlock(reader, "transform.out", kWidth, config.hidden_channels, 1);
  if (config.transform_mask) {
    const BlockTensors mask =
        ReadBiasedBlock(reader, "transform.mask", kWidth, config.hidden_channels, 1);
    out.convolution = Stacked({out.convolution, mask.convolution});
    out.bias.insert(out.bias.end(), mask.bias.begin(), mask.bias.end());
  }
  out_.emplace(kernels, grid_, 1, out, Activation::kNone);
}

void Transform::ReadActions(const TensorReader& reader) {
  const int n = config_.num_actions, stages = 1 + config_.transform_extra_stages;
  const std::vector<float> weights = reader.Read("transform.action.weight", {kWidth, n});
  const std::vector<float> bias = reader.Read("transform.action.bias", {kWidth});
  const float scale = reader.Read("transform.action_norm.scale", {1})[0];
  const float shift = reader.Read("transform.action_norm.shift", {1})[0];
  const float slope = config_.activation == "relu" ? 0.0F : kLeakySlope;
  actions_.resize(static_cast<std::size_t>(n));
  for (int a = 0; a < n; ++a) {
    std::vector<float> vector = bias;
    double mean = 0, square = 0;
    for (int i = 0; i < kWidth; ++i) mean += vector[i] += weights[i * n + a];
    mean /= kWidth;
    for (const float value : vector) square += (value - mean) * (value - mean);
    const double deviation = std::sqrt(square / kWidth + kEpsilon);
    for (float& value : vector) {
      value = static_cast<float>((value - mean) / deviation) * scale + shift;
      value = std::max(value, value * slope);
    }
    action_vectors_.push_back(std::move(vector));
  }
  if (config_.transform_action != "scale_and_shift") return;
  const int size = 2 * kWidth * 3 * stages;
  const std::vector<float> more = reader.Read("transform.modulation.weight", {size, n});
  const std::vector<float> base = reader.Read("transform.modulation.bias", {size});
  for (int a = 0; a < n; ++a) {
    actions_[a].modulation = base;
    for (int i = 0; i < size; ++i) actions_[a].modulation[i] += more[i * n + a];
  }
}

void Transform::AddTiled(const ConvolutionWeights& half) {
  const Grid grid{2 * deepest_.height, 2 * deepest_.width};
  const Grid kinds{std::min(kWindow, grid.height), std::min(kWindow, grid.width)};
  for (int p = 0; p < grid.pixels(); ++p) {
    tiled_row_.push_back(KindOfLine(p / grid.width, grid.height) * kinds.width +
                         KindOfLine(p % grid.width, grid.width));
  }
  for (std::size_t a = 0; a < actions_.size(); ++a)
    actions_[a].tiled = ConvolveConstant(kinds, 1, half, action_vectors_[a]);
}

void Transform::ReadBottleneck(const TensorReader& reader) {
  const Grid grid{2 * deepest_.height, 2 * deepest_.width};
  if (config_.bottleneck == "strided") {
    strided_.emplace(
        kernels_, grid, 2,
        ReadNormedBlock(reader, "transform.strided", kWidth, kWidth, kWindow, Activation::kRelu));
    small_.emplace(
        kernels_, deepest_, 1,
        ReadNormedBlock(reader, "transform.small", kWidth, kWidth, kWindow, Activation::kRelu));
    return;
  }
  const int cells = deepest_.pixels(), out = kWidth * cells;
  const std::vector<float> bias = reader.Read("transform.dense.bias", {out});
  const std::vector<float> read = reader.Read("transform.dense.weight", {out, 3 * kWidth});
  std::vector<float> weights(read.size()), base(bias.size());  // outputs pixel by pixel
  for (int o = 0; o < out; ++o) {
    const int to = o % cells * kWidth + o / cells;
    base[to] = bias[o];
    std::copy_n(read.begin() + std::ptrdiff_t{o} * 3 * kWidth, 3 * kWidth,
                weights.begin() + std::ptrdiff_t{to} * 3 * kWidth);
  }
  dense_.emplace(kernels_, 2 * kWidth, out, DenseInputs(weights, out, 3 * kWidth, 0, 2 * kWidth));
  for (std::size_t a = 0; a < actions_.size(); ++a) {
    actions_[a].dense = base;
    for (int o = 0; o < out; ++o) {
      for (int i = 0; i < kWidth; ++i)
        actions_[a].dense[o] +=
            weights[(static_cast<std::size_t>(o) * 3 + 2) * kWidth + i] * action_vectors_[a][i];
    }
  }
}

void Transform::ReadStages(const TensorReader& reader) {
  const int stages = 1 + config_.transform_extra_stages;
  const auto name = [](const char* list, int i) {
    return "transform." + std::string(list) + "." + std::to_string(i);
  };
  for (int i = 0; i < stages; ++i) {
    Stage stage;
    if (i > 0) {
      const Grid in{grid_.height >> (i - 1), grid_.width >> (i - 1)};
      stage.down.emplace(
          kernels_, in, 2,
          ReadNormedBlock(reader, name("down", i - 1), kWidth, kWidth, kWindow, Activation::kRelu));
    }
    const int from_below = stages - 1 - i;  // the deepest stage goes up first
    const Grid grid{grid_.height >> i, grid_.width >> i};
    stage.up.emplace(kernels_, Grid{grid.height / 2, grid.width / 2},
                     ReadDoublingBlock(reader, name("up", from_below), kWidth, kWidth),
                     NormedBlock::Doubling{});
    stage.join.emplace(
        kernels_, grid, 1,
        ReadNormedBlock(reader, name("join", from_below), (config_.skip ? 2 : 1) * kWidth, kWidth,
                        kWindow, Activation::kRelu));
    stages_.push_back(std::move(stage));
  }
}

void Transform::FoldRoot(const float* h0, float* root, Arena& arena) const {
  const Arena::Scope scope(arena);
  float* const features = arena.Take(MapSize(grid_, kWidth));
  from_h0_->Run(h0, 1, features, arena);
  merge_root_->Run(features, 1, root, arena);
}

const float* Transform::Modulation(const StateRow& row, int layer) const {
  const std::vector<float>& all = actions_[static_cast<std::size_t>(row.action)].modulation;
  return all.empty() ? nullptr : all.data() + std::ptrdiff_t{layer} * 2 * kWidth;
}

void Transform::Finish(const NormedBlock& block, const StateRow* rows, int count, int layer,
                       float* maps) const {
  for (int i = 0; i < count; ++i, maps += block.convolution().out_size())
    block.Normalise(maps, {}, Modulation(rows[i], layer));
}

void Transform::Merge(const StateRow* rows, int count, float* features, Arena& arena) const {
  const Arena::Scope scope(arena);
  const std::size_t hidden = MapSize(grid_, config_.hidden_channels);
  const std::size_t size = MapSize(grid_, kWidth);
  float* const states = arena.Take(static_cast<std::size_t>(count) * hidden);
  for (int i = 0; i < count; ++i) std::copy_n(rows[i].h, hidden, states + i * hidden);
  float* const from = arena.Take(static_cast<std::size_t>(count) * size);
  from_h_->Run(states, count, from, arena);
  merge_->Convolve(from, count, features, arena);
  for (int i = 0; i < count; ++i)
    merge_->Normalise(features + i * size, {rows[i].root, nullptr}, Modulation(rows[i], 0));
}

void Transform::SoftArgmax(const StateRow* rows, int count, const float* features, float* squeezed,
                           Arena& arena) const {
  const Grid grid = with_action_->convolution().out_grid();
  float* const positions = arena.Take(static_cast<std::size_t>(count) * 2 * kWidth);
  for (int i = 0; i < count; ++i) {
    kernels_.soft_argmax(features + i * MapSize(grid, kWidth), grid.height, grid.width, kWidth,
                         positions + std::ptrdiff_t{i} * 2 * kWidth);
  }
  MultiplyRows(kernels_, *dense_, positions, count, squeezed, arena);
  for (int i = 0; i < count; ++i) {
    const std::vector<float>& base = actions_[static_cast<std::size_t>(rows[i].action)].dense;
    kernels_.add(squeezed + i * base.size(), base.size(), base.data(), nullptr, Activation::kRelu);
  }
}

void Transform::Squeeze(const StateRow* rows, int count, const float* features, float* squeezed,
                        Arena& arena) const {
  const Arena::Scope scope(arena);
  const std::size_t size = with_action_->convolution().out_size();
  float* const told = arena.Take(static_cast<std::size_t>(count) * size);
  with_action_->Convolve(features, count, told, arena);
  for (int i = 0; i < count; ++i) {
    const ActionPart& action = actions_[static_cast<std::size_t>(rows[i].action)];
    with_action_->Normalise(told + i * size, {action.tiled.data(), tiled_row_.data()}, nullptr);
  }
  if (!strided_) return SoftArgmax(rows, count, told, squeezed, arena);
  float* const half = arena.Take(static_cast<std::size_t>(count) * MapSize(deepest_, kWidth));
  strided_->Run(told, count, half, arena);
  small_->Run(half, count, squeezed, arena);
}

void Transform::Join(const Stage& stage, const float* up, const float* skip, int count, float* out,
                     Arena& arena) const {
  if (!config_.skip) return stage.join->Convolve(up, count, out, arena);
  const Arena::Scope scope(arena);
  const std::size_t pixels =
      static_cast<std::size_t>(count) * stage.join->convolution().in_grid().pixels();
  float* const both = arena.Take(pixels * 2 * kWidth);
  for (std::size_t p = 0; p < pixels; ++p) {
    std::copy_n(up + p * kWidth, kWidth, both + 2 * p * kWidth);
    std::copy_n(skip + p * kWidth, kWidth, both + (2 * p + 1) * kWidth);
  }
  stage.join->Convolve(both, count, out, arena);
}

void Transform::Output(const StateRow* rows, int count, const float* features, float* next,
                       Arena& arena) const {
  const int channels = config_.hidden_channels, pixels = grid_.pixels();
  const std::size_t size = out_->convolution().out_size();
  float* const both = arena.Take(static_cast<std::size_t>(count) * size);
  out_->Run(features, count, both, arena);
  kernels_.sigmoid(both, static_cast<std::size_t>(count) * size);
  if (!config_.transform_mask) {
    std::copy_n(both, static_cast<std::size_t>(count) * size, next);
    return;
  }
  const float* from = both;
  for (int i = 0; i < count; ++i) {
    const float* h = rows[i].h;
    for (int p = 0; p < pixels; ++p, from += 2 * channels) {
      for (int c = 0; c < channels; ++c, ++h) *next++ = *h + from[channels + c] * (from[c] - *h);
    }
  }
}

void Transform::Run(const StateRow* rows, int count, float* next, Arena& arena) const {
  const Arena::Scope scope(arena);
  const auto maps = static_cast<std::size_t>(count);
  const auto take = [&](const NormedBlock& block) {
    return arena.Take(maps * block.convolution().out_size());
  };
  std::array<float*, kMostStages> skips;
  skips[0] = take(*merge_);
  Merge(rows, count, skips[0], arena);
  int layer = 1;
  for (std::size_t i = 1; i < stages_.size(); ++i, ++layer) {
    skips[i] = take(*stages_[i].down);
    stages_[i].down->Convolve(skips[i - 1], count, skips[i], arena);
    Finish(*stages_[i].down, rows, count, layer, skips[i]);
  }
  float* z = arena.Take(maps * MapSize(deepest_, kWidth));
  Squeeze(rows, count, skips[stages_.size() - 1], z, arena);
  for (std::size_t i = stages_.size(); i-- > 0; layer += 2) {
    float* const up = take(*stages_[i].up);
    stages_[i].up->Convolve(z, count, up, arena);
    Finish(*stages_[i].up, rows, count, layer, up);
    z = take(*stages_[i].join);
    Join(stages_[i], up, skips[i], count, z, arena);
    Finish(*stages_[i].join, rows, count, layer + 1, z);
  }
  Output(rows, count, z, next, arena);
}

}  // namespace prospect::model::inference
