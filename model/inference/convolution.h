#pragma once

#include <memory>
#include <vector>

#include "model/inference/arena.h"
#include "model/inference/grid.h"
#include "model/inference/kernels.h"

namespace prospect::model::inference {

/// Weights of a convolution, [out][in][kernel][kernel] as libtorch has them. A plain value.
struct ConvolutionWeights {
  int out = 0, in = 0, kernel = 0;
  std::vector<float> values;

  float at(int o, int i, int y, int x) const {
    return values[((static_cast<std::size_t>(o) * in + i) * kernel + y) * kernel + x];
  }
  /// Only `count` inputs from `first` on.
  ConvolutionWeights Inputs(int first, int count) const;
};

/// One above the other: the outputs of each in turn. Same inputs and kernels.
ConvolutionWeights Stacked(const std::vector<ConvolutionWeights>& parts);

/// Padding that gives input size / stride: an even kernel of stride 1 has one more at bottom and
/// right.
struct Padding {
  int before = 0, after = 0;
};
Padding SamePadding(int kernel, int stride);
Grid OutputGrid(Grid in, int kernel, int stride);

/// A convolution of maps, without a bias: what follows it adds that, or normalises it away.
/// Immutable; several threads may run one, each with an arena of its own. A map's result does not
/// depend on the maps beside it.
class Convolution {
 public:
  virtual ~Convolution() = default;
  /// `maps` maps, one after the other, to as many of out_grid() and out_channels().
  virtual void Run(const float* in, int maps, float* out, Arena& arena) const = 0;

  Grid in_grid() const { return in_grid_; }
  Grid out_grid() const { return out_grid_; }
  int in_channels() const { return in_channels_; }
  int out_channels() const { return out_channels_; }
  std::size_t in_size() const { return MapSize(in_grid_, in_channels_); }
  std::size_t out_size() const { return MapSize(out_grid_, out_channels_); }

 protected:
  Convolution(Grid in_grid, int in_channels, Grid out_grid, int out_channels)
      : in_grid_(in_grid),
        out_grid_(out_grid),
        in_channels_(in_channels),
        out_channels_(out_channels) {}

 private:
  Grid in_grid_, out_grid_;
  int in_channels_, out_channels_;
};

/// The fastest way to compute a convolution of this shape: Winograd's for windows of 5 x 5 and
/// 3 x 3 that move by one pixel, else a product where the windows lie.
std::unique_ptr<Convolution> MakeConvolution(const Kernels& kernels, Grid in, int stride,
                                             const ConvolutionWeights& weights);

/// A 3 x 3 convolution to four times the channels and a pixel shuffle, which doubles height and
/// width.
std::unique_ptr<Convolution> MakeDoubling(const Kernels& kernels, Grid in,
                                          const ConvolutionWeights& weights);

/// What a convolution gives for a map that holds `input` [in] at every pixel of its grid.
std::vector<float> ConvolveConstant(Grid in, int stride, const ConvolutionWeights& weights,
                                    const std::vector<float>& input);

}  // namespace prospect::model::inference
