#include "tools/common/interval.h"

#include <gtest/gtest.h>

namespace prospect::tools {
namespace {

// Textbook value: 8 of 10 gives a Wilson interval of 0.490 to 0.943.
TEST(ShareOf, EightOfTen) {
  const Share share = ShareOf(8, 10);
  EXPECT_DOUBLE_EQ(share.value, 0.8);
  EXPECT_NEAR(share.low, 0.4902, 1e-4);
  EXPECT_NEAR(share.high, 0.9433, 1e-4);
}

TEST(ShareOf, StaysInsideZeroAndOne) {
  EXPECT_EQ(ShareOf(0, 5).low, 0);
  EXPECT_GT(ShareOf(0, 5).high, 0.3);
  EXPECT_EQ(ShareOf(5, 5).high, 1);
  EXPECT_LT(ShareOf(5, 5).low, 0.7);
}

TEST(ShareOf, NothingKnownOfNothing) {
  const Share share = ShareOf(0, 0);
  EXPECT_EQ(share.value, 0);
  EXPECT_EQ(share.low, 0);
  EXPECT_EQ(share.high, 1);
}

}  // namespace
}  // namespace prospect::tools
