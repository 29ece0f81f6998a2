#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "model/inference/convolution.h"
#include "model/inference/packed_matrix.h"
#include "model/inference/painting.h"

/// The kernels of every instruction set that this machine has, against sums written out.
namespace prospect::model::inference {
namespace {

std::vector<float> Random(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<float> values(count);
  for (float& value : values) value = normal(random);
  return values;
}

class KernelsTest : public testing::TestWithParam<const Kernels*> {
 protected:
  const Kernels& kernels_ = *GetParam();
  Arena arena_;
};
INSTANTIATE_TEST_SUITE_P(Of, KernelsTest, testing::ValuesIn(RunnableKernels()),
                         [](const auto& test) { return std::string(test.param->name); });

TEST_P(KernelsTest, MultiplyAnyNumberOfRowsAndOutputs) {
  for (const int rows : {1, 2, 3, 8, 13}) {
    for (const int outputs : {1, 8, 31, 32, 33, 100}) {
      constexpr int kInputs = 19;
      const auto weights = Random(static_cast<std::size_t>(kInputs * outputs), 1);
      const auto from = Random(static_cast<std::size_t>(rows * kInputs), 2);
      std::vector<float> to(static_cast<std::size_t>(rows * outputs) + 1, 7.0F);
      const PackedMatrix packed(kernels_, kInputs, outputs, weights);
      MultiplyRows(kernels_, packed, from.data(), rows, to.data(), arena_);
      EXPECT_EQ(to.back(), 7.0F) << "nothing is written behind the last row";
      for (int i = 0; i < rows * outputs; ++i) {
        double sum = 0;
        for (int k = 0; k < kInputs; ++k)
          sum += double{from[i / outputs * kInputs + k]} * weights[k * outputs + i % outputs];
        ASSERT_NEAR(to[i], sum, 1e-4) << rows << " x " << outputs;
      }
    }
  }
}

double WrittenOut(const std::vector<float>& map, Grid grid, const ConvolutionWeights& w, int stride,
                  int y, int x, int o) {
  const int before = SamePadding(w.kernel, stride).before;
  double sum = 0;
  for (int j = 0; j < w.kernel; ++j) {
    for (int i = 0; i < w.kernel; ++i) {
      const int row = y * stride + j - before, column = x * stride + i - before;
      if (row < 0 || row >= grid.height || column < 0 || column >= grid.width) continue;
      for (int c = 0; c < w.in; ++c)
        sum += double{map[static_cast<std::size_t>(row * grid.width + column) * w.in + c]} *
               w.at(o, c, j, i);
    }
  }
  return sum;
}

ConvolutionWeights RandomWeights(int out, int in, int kernel) {
  return {out, in, kernel, Random(static_cast<std::size_t>(out * in * kernel * kernel), 3)};
}

TEST_P(KernelsTest, ConvolutionsAreTheSumsTheyStandFor) {
  struct Shape {
    int in, out, kernel, stride;
  };
  for (const Shape& s : {Shape{8, 32, 1, 1},
                         {3, 32, 7, 1},
                         {8, 32, 4, 1},
                         {32, 64, 4, 2},
                         {32, 32, 5, 2},
                         {16, 32, 5, 1},
                         {32, 16, 3, 1},
                         {5, 3, 5, 1}}) {
    for (const Grid grid : {Grid{8, 8}, {4, 4}, {2, 2}, {6, 8}, {3, 4}, {12, 16}}) {
      if (s.stride == 2 && (grid.height % 2 != 0 || s.kernel > grid.height + 2)) continue;
      const ConvolutionWeights weights = RandomWeights(s.out, s.in, s.kernel);
      const auto convolution = MakeConvolution(kernels_, grid, s.stride, weights);
      constexpr int kMaps = 2;
      const auto maps = Random(kMaps * convolution->in_size(), 4);
      std::vector<float> out(kMaps * convolution->out_size());
      convolution->Run(maps.data(), kMaps, out.data(), arena_);
      const std::vector<float> second(maps.begin() + convolution->in_size(), maps.end());
      const Grid to = convolution->out_grid();
      for (int p = 0; p < to.pixels(); ++p) {
        for (int o = 0; o < s.out; ++o) {
          const float found =
              out[convolution->out_size() + static_cast<std::size_t>(p * s.out + o)];
          const double sum =
              WrittenOut(second, grid, weights, s.stride, p / to.width, p % to.width, o);
          ASSERT_NEAR(found, sum, 2e-4 * std::sqrt(s.in) * s.kernel) << s.kernel << " " << s.stride;
        }
      }
    }
  }
}

TEST_P(KernelsTest, DoublingShufflesFourOutputsToAPixel) {
  const Grid grid{3, 5};
  const ConvolutionWeights weights = RandomWeights(64, 16, 3);
  const auto doubling = MakeDoubling(kernels_, grid, weights);
  const auto map = Random(doubling->in_size(), 5);
  std::vector<float> out(doubling->out_size());
  doubling->Run(map.data(), 1, out.data(), arena_);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 10; ++x) {
      for (int c = 0; c < 16; ++c) {
        const int o = c * 4 + y % 2 * 2 + x % 2;
        ASSERT_NEAR(out[static_cast<std::size_t>((y * 10 + x) * 16 + c)],
                    WrittenOut(map, grid, weights, 1, y / 2, x / 2, o), 1e-3);
      }
    }
  }
}

TEST_P(KernelsTest, AConstantMapIsFoldedToTheSameSums) {
  const ConvolutionWeights weights = RandomWeights(64, 32, 4);
  const auto convolution = MakeConvolution(kernels_, {8, 8}, 2, weights);
  const auto input = Random(32, 6);
  std::vector<float> map, out(convolution->out_size());
  for (int p = 0; p < 64; ++p) map.insert(map.end(), input.begin(), input.end());
  convolution->Run(map.data(), 1, out.data(), arena_);
  const std::vector<float> folded = ConvolveConstant({8, 8}, 2, weights, input);
  ASSERT_EQ(folded.size(), out.size());
  for (std::size_t i = 0; i < out.size(); ++i) ASSERT_NEAR(folded[i], out[i], 1e-3);
}

TEST_P(KernelsTest, NormalisesAfterAddingAndActivatesLast) {
  constexpr int kPixels = 50, kChannels = 32;
  auto map = Random(kPixels * kChannels, 7);
  const auto kinds = Random(3 * kChannels, 8), scale = Random(kChannels, 9);
  const auto shift = Random(kChannels, 10), modulation = Random(2 * kChannels, 11);
  std::vector<std::int32_t> kind(kPixels);
  for (int p = 0; p < kPixels; ++p) kind[p] = p % 3;
  const auto before = map;
  kernels_.normalise(map.data(), kPixels, kChannels, {kinds.data(), kind.data()},
                     {scale.data(), shift.data(), modulation.data()}, Activation::kLeakyRelu);
  for (int c = 0; c < kChannels; ++c) {
    const auto at = [&](int p) {
      return double{before[p * kChannels + c]} + kinds[kind[p] * kChannels + c];
    };
    double mean = 0, square = 0;
    for (int p = 0; p < kPixels; ++p) mean += at(p) / kPixels;
    for (int p = 0; p < kPixels; ++p) square += (at(p) - mean) * (at(p) - mean) / kPixels;
    for (int p = 0; p < kPixels; ++p) {
      double y = (at(p) - mean) / std::sqrt(square + 1e-5) * scale[c] + shift[c];
      y = y * (1 + modulation[c]) + modulation[kChannels + c];
      ASSERT_NEAR(map[p * kChannels + c], y > 0 ? y : 0.2 * y, 1e-4);
    }
  }
}

TEST_P(KernelsTest, SigmoidIsExactAtBothEndsAndForAnyCount) {
  for (const std::size_t count : {1U, 15U, 16U, 37U}) {
    std::vector<float> x(count + 1, 3.0F);
    for (std::size_t i = 0; i < count; ++i) x[i] = static_cast<float>(i * 9) - 120;
    const auto before = x;
    kernels_.sigmoid(x.data(), count);
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_NEAR(x[i], 1 / (1 + std::exp(-double{before[i]})), 2e-7);
    EXPECT_EQ(x[count], 3.0F);
  }
}

TEST_P(KernelsTest, SoftArgmaxFindsAPeak) {
  std::vector<float> map(5 * 5 * 16, 0.0F), positions(32);
  map[(4 * 5 + 0) * 16 + 3] = 100;  // last row, first column of one channel
  kernels_.soft_argmax(map.data(), 5, 5, 16, positions.data());
  EXPECT_NEAR(positions[6], 1, 1e-4);
  EXPECT_NEAR(positions[7], -1, 1e-4);
  EXPECT_NEAR(positions[0], 0, 1e-5);
}

TEST(Arena, GivesWhatWasReturnedAgainAndSettles) {
  Arena arena;
  for (int round = 0; round < 3; ++round) {
    const Arena::Scope scope(arena);
    float* const first = arena.Take(1000);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(first) % 64, 0U);
    float* inner = nullptr;
    {
      const Arena::Scope nested(arena);
      inner = arena.Take(100'000);
      inner[99'999] = 1;
    }
    EXPECT_EQ(arena.Take(50'000), inner) << "what a scope gave back is taken first";
  }
  const std::size_t settled = arena.capacity();
  const Arena::Scope scope(arena);
  arena.Take(100'000);
  EXPECT_EQ(arena.capacity(), settled);
}

TEST(PaintOnto, KeepsWhatWasSeenWhereNothingChanges) {
  const Grid grid{4, 4};
  SeenPicture start;
  start.seen = std::vector<float>(48, 0.5F);
  start.decoded_start = std::vector<float>(48, 0.25F);  // redrawn half as bright
  std::vector<float> decoded = start.decoded_start;
  decoded[47] = 0.5F;
  PaintOnto(start, grid, /*compose=*/true, decoded.data());
  EXPECT_FLOAT_EQ(decoded[0], 0.5F);
  EXPECT_FLOAT_EQ(decoded[47], 1.0F);
}

}  // namespace
}  // namespace prospect::model::inference
