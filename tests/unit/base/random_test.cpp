#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prospect::base {
namespace {

TEST(Random, SeedsGiveTheirOwnStreams) {
  Random a(1), b(1), c(2);
  const std::uint64_t first = a.Next();
  EXPECT_EQ(first, b.Next());
  EXPECT_NE(first, c.Next());
  EXPECT_NE(MixSeeds({1, 2}), MixSeeds({2, 1}));
}

// Scenes, noise and training are drawn with these: the same in every version and on every machine.
TEST(Random, StreamsAreFixed) {
  EXPECT_EQ(MixSeeds({1, 2, 3}), 0xcd8d705991914ea1ULL);
  Random random(5);
  EXPECT_EQ(random.Next(), 0xfad6e24671254235ULL);
  EXPECT_EQ(random.Next(), 0xe17b6d147da182daULL);
  random.Normal();  // two draws
  EXPECT_EQ(random.Below(1000), 893);
  EXPECT_EQ(random.Uniform(), 0x1.c0d6a3dd92d1dp-1);
}

TEST(Random, UniformFillsItsRange) {
  Random random(5);
  double sum = 0, low = 1, high = 0;
  for (int i = 0; i < 100000; ++i) {
    const double value = random.Uniform();
    sum += value;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  EXPECT_NEAR(sum / 100000, 0.5, 0.005);
  EXPECT_GE(low, 0.0);
  EXPECT_LT(high, 1.0);
}

TEST(Random, BelowIsFair) {
  Random random(6);
  int counts[7] = {};
  for (int i = 0; i < 70000; ++i) ++counts[random.Below(7)];
  for (int count : counts) EXPECT_NEAR(count, 10000, 400);
}

TEST(Random, NormalHasItsMomentsAndBoundedKeepsItsBound) {
  Random random(7);
  double sum = 0, squares = 0;
  for (int i = 0; i < 100000; ++i) {
    const double value = random.Normal();
    sum += value;
    squares += value * value;
    EXPECT_LE(std::abs(random.BoundedNormal()), 2.5);
  }
  EXPECT_NEAR(sum / 100000, 0.0, 0.02);
  EXPECT_NEAR(squares / 100000, 1.0, 0.02);
}

}  // namespace
}  // namespace prospect::base
