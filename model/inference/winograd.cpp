#include "model/inference/winograd.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/inference/packed_matrix.h"

namespace prospect::model::inference {
namespace {

constexpr int kTile = 4;    // output pixels of a tile, each way
constexpr int kGroup = 16;  // tiles that share one reading of the weights

/// The window's transform: one row a point of interpolation, scaled as the kernels' other two
/// transforms want it (the last row is infinity's).
std::vector<std::vector<double>> WindowTransform(int kernel) {
  struct Point {
    double at, scale;
  };
  const std::vector<Point> five = {{0, 1},           {1, -2.0 / 9},  {-1, -2.0 / 9},
                                   {2, 1.0 / 90},    {-2, 1.0 / 90}, {0.5, 32.0 / 45},
                                   {-0.5, 32.0 / 45}};
  const std::vector<Point> three = {
      {0, 1.0 / 4}, {1, -1.0 / 6}, {-1, -1.0 / 6}, {2, 1.0 / 24}, {-2, 1.0 / 24}};
  std::vector<std::vector<double>> rows;
  for (const Point& point : kernel == 5 ? five : three) {
    std::vector<double> row;
    for (int power = 0; power < kernel; ++power)
      row.push_back(point.scale * std::pow(point.at, power));
    rows.push_back(row);
  }
  rows.push_back(std::vector<double>(static_cast<std::size_t>(kernel), 0.0));
  rows.back().back() = 1;
  return rows;
}

class Winograd : public Convolution {
 public:
  Winograd(const Kernels& kernels, Grid in, const ConvolutionWeights& weights, int doubling)
      : Convolution(in, weights.in, {in.height * doubling, in.width * doubling},
                    weights.out / (doubling * doubling)),
        kernels_(kernels),
        kernel_(weights.kernel),
        doubling_(doubling),
        outputs_(weights.out),
        points_(kTile + weights.kernel - 1),
        down_((in.height + kTile - 1) / kTile),
        across_((in.width + kTile - 1) / kTile),
        zeros_(static_cast<std::size_t>(weights.in), 0.0F) {
    for (const std::vector<float>& values : AtPoints(weights))
      weights_.emplace_back(kernels, weights.in, weights.out, values);
  }

  void Run(const float* in, int maps, float* out, Arena& arena) const override {
    const int tiles = maps * down_ * across_;
    for (int first = 0; first < tiles; first += kGroup)
      RunGroup(in, first, std::min(kGroup, tiles - first), out, arena);
  }

 private:
  struct Place {
    int map, top, left;  // in input pixels
  };

  Place PlaceOf(int tile) const {
    return {tile / (down_ * across_), tile / across_ % down_ * kTile, tile % across_ * kTile};
  }

  /// The weights at each point, [in][out]. Outputs of a pixel shuffle lie phase by phase, so that
  /// each phase's channels are neighbours.
  std::vector<std::vector<float>> AtPoints(const ConvolutionWeights& w) const {
    const auto transform = WindowTransform(kernel_);
    const int phases = doubling_ * doubling_, channels = outputs_ / phases;
    std::vector<std::vector<float>> values(
        static_cast<std::size_t>(points_ * points_),
        std::vector<float>(static_cast<std::size_t>(w.in) * static_cast<std::size_t>(w.out)));
    for (int i = 0; i < w.in; ++i) {
      for (int o = 0; o < w.out; ++o) {
        const int to = o % phases * channels + o / phases;
        for (int y = 0; y < points_; ++y) {
          const std::array<double, 5> line = DownOf(w, o, i, transform[y]);
          for (int x = 0; x < points_; ++x) {
            double sum = 0;
            for (int k = 0; k < kernel_; ++k) sum += transform[x][k] * line[k];
            values[y * points_ + x][static_cast<std::size_t>(i) * w.out + to] =
                static_cast<float>(sum);
          }
        }
      }
    }
    return values;
  }

  /// One row of the transform applied down each column of a window.
  std::array<double, 5> DownOf(const ConvolutionWeights& w, int o, int i,
                               const std::vector<double>& row) const {
    std::array<double, 5> line{};
    for (int k = 0; k < kernel_; ++k) {
      for (int x = 0; x < kernel_; ++x) line[x] += row[k] * w.at(o, i, k, x);
    }
    return line;
  }

  void RunGroup(const float* in, int first, int tiles, float* out, Arena& arena) const {
    const Arena::Scope scope(arena);
    const auto count = static_cast<std::size_t>(points_ * points_);
    const std::ptrdiff_t in_stride = std::ptrdiff_t{tiles} * in_channels();
    const std::ptrdiff_t out_stride = std::ptrdiff_t{tiles} * outputs_;
    float* const before = arena.Take(count * static_cast<std::size_t>(in_stride));
    float* const after = arena.Take(count * static_cast<std::size_t>(out_stride));
    for (int t = 0; t < tiles; ++t)
      TransformIn(in, PlaceOf(first + t), before + std::ptrdiff_t{t} * in_channels(), in_stride);
    for (std::size_t point = 0; point < count; ++point) {
      const auto at = static_cast<std::ptrdiff_t>(point);
      MultiplyRows(kernels_, weights_[point], before + at * in_stride, tiles,
                   after + at * out_stride, arena);
    }
    for (int t = 0; t < tiles; ++t)
      TransformOut(after + std::ptrdiff_t{t} * outputs_, out_stride, PlaceOf(first + t), out);
  }

  void TransformIn(const float* in, const Place& place, float* to, std::ptrdiff_t stride) const {
    std::array<const float*, 64> pixels;
    const int reach = kernel_ / 2;
    const Grid grid = in_grid();
    std::size_t i = 0;
    for (int y = place.top - reach; y < place.top - reach + points_; ++y) {
      for (int x = place.left - reach; x < place.left - reach + points_; ++x, ++i) {
        const bool inside = y >= 0 && y < grid.height && x >= 0 && x < grid.width;
        const std::ptrdiff_t pixel = (std::ptrdiff_t{place.map} * grid.height + y) * grid.width + x;
        pixels[i] = inside ? in + pixel * in_channels() : zeros_.data();
      }
    }
    const auto transform = kernel_ == 5 ? kernels_.winograd_in_5 : kernels_.winograd_in_3;
    transform(pixels.data(), in_channels(), to, stride);
  }

  void TransformOut(const float* from, std::ptrdiff_t stride, const Place& place,
                    float* out) const {
    std::array<float*, kTile * kTile> pixels;
    const auto transform = kernel_ == 5 ? kernels_.winograd_out_5 : kernels_.winograd_out_3;
    const Grid grid = out_grid();
    for (int phase = 0; phase < doubling_ * doubling_; ++phase) {
      for (int p = 0; p < kTile * kTile; ++p) {
        const int y = place.top + p / kTile, x = place.left + p % kTile;
        const bool inside = y < in_grid().height && x < in_grid().width;
        const int row = y * doubling_ + phase / doubling_;
        const int column = x * doubling_ + phase % doubling_;
        const std::ptrdiff_t pixel =
            (std::ptrdiff_t{place.map} * grid.height + row) * grid.width + column;
        pixels[static_cast<std::size_t>(p)] = inside ? out + pixel * out_channels() : nullptr;
      }
      transform(from + std::ptrdiff_t{phase} * out_channels(), stride, out_channels(),
                pixels.data());
    }
  }

  const Kernels& kernels_;
  int kernel_, doubling_, outputs_, points_, down_, across_;
  std::vector<float> zeros_;  // a pixel outside the map
  std::vector<PackedMatrix> weights_;
};

}  // namespace

bool FitsWinograd(const ConvolutionWeights& weights) {
  return (weights.kernel == 5 || weights.kernel == 3) && weights.in % 16 == 0 &&
         weights.out % 16 == 0;
}

std::unique_ptr<Convolution> MakeWinograd(const Kernels& kernels, Grid in,
                                          const ConvolutionWeights& weights, int doubling) {
  return std::make_unique<Winograd>(kernels, in, weights, doubling);
}

}  // namespace prospect::model::inference
