#include "model/inference/convolution.h"

#include <algorithm>
#include <cstring>

#include "model/inference/packed_matrix.h"
#include "model/inference/winograd.h"

namespace prospect::model::inference {
namespace {

/// [kernel][kernel][in] by [out], the order in which a window lies in a map.
std::vector<float> WindowMajor(const ConvolutionWeights& w) {
  std::vector<float> values;
  values.reserve(w.values.size());
  for (int y = 0; y < w.kernel; ++y) {
    for (int x = 0; x < w.kernel; ++x) {
      for (int i = 0; i < w.in; ++i) {
        for (int o = 0; o < w.out; ++o) values.push_back(w.at(o, i, y, x));
      }
    }
  }
  return values;
}

/// A product of windows where they lie in a padded copy of the map: a window is a few runs of
/// neighbouring numbers, so nothing is gathered.
class DirectConvolution : public Convolution {
 public:
  DirectConvolution(const Kernels& kernels, Grid in, int stride, const ConvolutionWeights& weights)
      : Convolution(in, weights.in, OutputGrid(in, weights.kernel, stride), weights.out),
        kernels_(kernels),
        kernel_(weights.kernel),
        stride_(stride),
        padding_(SamePadding(weights.kernel, stride)),
        padded_{in.height + padding_.before + padding_.after,
                in.width + padding_.before + padding_.after},
        weights_(kernels, weights.kernel * weights.kernel * weights.in, weights.out,
                 WindowMajor(weights)) {}

  void Run(const float* in, int maps, float* out, Arena& arena) const override {
    const Arena::Scope scope(arena);
    const float* const padded = padded_ == in_grid() ? in : Padded(in, maps, arena);
    const auto windows = static_cast<std::size_t>(maps) * out_grid().pixels();
    auto** const from = arena.Take<const float*>(windows);
    auto** const to = arena.Take<float*>(windows);
    const std::ptrdiff_t line = std::ptrdiff_t{padded_.width} * in_channels();
    std::size_t i = 0;
    for (int map = 0; map < maps; ++map) {
      for (int y = 0; y < out_grid().height; ++y) {
        for (int x = 0; x < out_grid().width; ++x, ++i) {
          from[i] = padded + (std::ptrdiff_t{map} * padded_.height + y * stride_) * line +
                    std::ptrdiff_t{x} * stride_ * in_channels();
          to[i] = out + static_cast<std::ptrdiff_t>(i) * out_channels();
        }
      }
    }
    kernels_.multiply({from, to, static_cast<int>(windows), kernel_, kernel_ * in_channels(), line},
                      weights_.data(), out_channels());
  }

 private:
  float* Padded(const float* in, int maps, Arena& arena) const {
    const std::size_t size = static_cast<std::size_t>(maps) * MapSize(padded_, in_channels());
    float* const padded = arena.Take(size);
    std::fill(padded, padded + size, 0.0F);
    const std::size_t line = static_cast<std::size_t>(in_grid().width) * in_channels();
    for (int map = 0; map < maps; ++map) {
      for (int y = 0; y < in_grid().height; ++y, in += line) {
        const std::ptrdiff_t pixel =
            (std::ptrdiff_t{map} * padded_.height + y + padding_.before) * padded_.width +
            padding_.before;
        std::copy(in, in + line, padded + pixel * in_channels());
      }
    }
    return padded;
  }

  const Kernels& kernels_;
  int kernel_, stride_;
  Padding padding_;
  Grid padded_;
  PackedMatrix weights_;
};

}  // namespace

ConvolutionWeights ConvolutionWeights::Inputs(int first, int count) const {
  ConvolutionWeights some{out, count, kernel, {}};
  const auto window = static_cast<std::ptrdiff_t>(kernel) * kernel;
  for (int o = 0; o < out; ++o) {
    const auto begin = values.begin() + (static_cast<std::ptrdiff_t>(o) * in + first) * window;
    some.values.insert(some.values.end(), begin, begin + count * window);
  }
  return some;
}

ConvolutionWeights Stacked(const std::vector<ConvolutionWeights>& parts) {
  ConvolutionWeights all = parts.front();
  for (auto part = parts.begin() + 1; part != parts.end(); ++part) {
    all.out += part->out;
    all.values.insert(all.values.end(), part->values.begin(), part->values.end());
  }
  return all;
}

Padding SamePadding(int kernel, int stride) {
  const int before = (kernel - 1) / 2;
  return {before, stride == 1 ? kernel - 1 - before : before};
}

Grid OutputGrid(Grid in, int kernel, int stride) {
  const Padding padding = SamePadding(kernel, stride);
  const int more = padding.before + padding.after - kernel;
  return {(in.height + more) / stride + 1, (in.width + more) / stride + 1};
}

std::unique_ptr<Convolution> MakeConvolution(const Kernels& kernels, Grid in, int stride,
                                             const ConvolutionWeights& weights) {
  if (stride == 1 && FitsWinograd(weights)) return MakeWinograd(kernels, in, weights, 1);
  return std::make_unique<DirectConvolution>(kernels, in, stride, weights);
}

std::unique_ptr<Convolution> MakeDoubling(const Kernels& kernels, Grid in,
                                          const ConvolutionWeights& weights) {
  return MakeWinograd(kernels, in, weights, 2);
}

std::vector<float> ConvolveConstant(Grid in, int stride, const ConvolutionWeights& w,
                                    const std::vector<float>& input) {
  const Padding padding = SamePadding(w.kernel, stride);
  const Grid out = OutputGrid(in, w.kernel, stride);
  std::vector<float> taps;  // what each place of the window adds, [kernel][kernel][out]
  for (int y = 0; y < w.kernel; ++y) {
    for (int x = 0; x < w.kernel; ++x) {
      for (int o = 0; o < w.out; ++o) {
        double sum = 0;
        for (int i = 0; i < w.in; ++i) sum += double{w.at(o, i, y, x)} * input[i];
        taps.push_back(static_cast<float>(sum));
      }
    }
  }
  std::vector<float> map(MapSize(out, w.out), 0.0F);
  for (int p = 0; p < out.pixels(); ++p) {
    const int top = p / out.width * stride - padding.before;
    const int left = p % out.width * stride - padding.before;
    for (int y = std::max(0, -top); y < std::min(w.kernel, in.height - top); ++y) {
      for (int x = std::max(0, -left); x < std::min(w.kernel, in.width - left); ++x) {
        const float* tap = taps.data() + static_cast<std::ptrdiff_t>(y * w.kernel + x) * w.out;
        for (int o = 0; o < w.out; ++o) map[static_cast<std::size_t>(p) * w.out + o] += tap[o];
      }
    }
  }
  return map;
}

}  // namespace prospect::model::inference
