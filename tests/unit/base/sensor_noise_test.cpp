#include "base/sensor_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "base/hash.h"

namespace prospect::base {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes Noisy(std::size_t n, std::uint64_t seed, std::int64_t frame, double sigma,
            std::uint8_t level = 128) {
  Bytes bytes(n, level);
  AddSensorNoise(bytes.data(), n, seed, frame, sigma);
  return bytes;
}

TEST(SensorNoise, IsAFunctionOfSeedFrameAndPixelAlone) {
  const Bytes first = Noisy(12288, 7, 3, 0.01);
  Noisy(100, 8, 1, 0.02);  // calls in between change nothing
  EXPECT_EQ(first, Noisy(12288, 7, 3, 0.01));
  EXPECT_NE(first, Noisy(12288, 8, 3, 0.01));
  EXPECT_NE(first, Noisy(12288, 7, 4, 0.01));
}

TEST(SensorNoise, IsFixed) {
  const Bytes bytes = Noisy(3000, 7, 3, 0.01);
  EXPECT_EQ(HashBytes(bytes.data(), bytes.size()), 0xfba3e3860325a512ULL);
}

TEST(SensorNoise, AShorterPictureSeesTheSameNoise) {
  const Bytes whole = Noisy(1000, 1, 2, 0.01);
  for (std::size_t n : {1u, 2u, 3u, 4u, 5u, 997u}) {
    EXPECT_EQ(Bytes(whole.begin(), whole.begin() + n), Noisy(n, 1, 2, 0.01)) << n;
  }
}

TEST(SensorNoise, HasTheMomentsOfAGaussian) {
  const Bytes bytes = Noisy(400000, 5, 0, 0.01);
  double sum = 0, squares = 0, fourth = 0;
  for (std::uint8_t value : bytes) sum += value - 128.0;
  const double mean = sum / bytes.size();
  for (std::uint8_t value : bytes) {
    const double d = value - 128.0 - mean;
    squares += d * d;
    fourth += d * d * d * d;
  }
  const double variance = squares / bytes.size();
  EXPECT_NEAR(mean, 0.0, 0.02);
  EXPECT_NEAR(std::sqrt(variance), std::sqrt(2.55 * 2.55 + 1.0 / 12), 0.02);  // rounding adds 1/12
  EXPECT_NEAR(fourth / bytes.size() / (variance * variance), 3.0, 0.05);
}

TEST(SensorNoise, NeighboursAreIndependent) {
  const Bytes bytes = Noisy(400000, 5, 0, 0.01);
  for (std::size_t lag : {1u, 2u, 3u, 4u, 192u}) {
    double product = 0;
    for (std::size_t i = lag; i < bytes.size(); ++i) {
      product += (bytes[i] - 128.0) * (bytes[i - lag] - 128.0);
    }
    EXPECT_NEAR(product / bytes.size() / (2.55 * 2.55), 0.0, 0.01) << lag;
  }
}

TEST(SensorNoise, ClampsAtBothEnds) {
  for (std::uint8_t level : {0, 255}) {
    for (std::uint8_t value : Noisy(10000, 1, 1, 0.05, level)) {
      EXPECT_LE(std::abs(value - level), 60);  // a wrapped value would be far away
    }
  }
}

TEST(SensorNoise, NoSigmaNoNoise) { EXPECT_EQ(Noisy(100, 1, 1, 0.0), Bytes(100, 128)); }

TEST(SensorNoise, RefusesASigmaOutOfRange) {
  EXPECT_THROW(Noisy(10, 1, 1, -0.01), std::invalid_argument);
  EXPECT_THROW(Noisy(10, 1, 1, 0.3), std::invalid_argument);
  EXPECT_THROW(Noisy(10, 1, 1, std::nan("")), std::invalid_argument);
}

// Stored data sets and weights depend on these bits: another value here means that old data reads
// differently.
TEST(SensorNoise, KeepsItsBits) {
  const Bytes bytes = Noisy(8, 42, 7, 0.01);
  EXPECT_EQ(bytes, (Bytes{129, 129, 126, 129, 122, 134, 130, 126}));
}

}  // namespace
}  // namespace prospect::base
