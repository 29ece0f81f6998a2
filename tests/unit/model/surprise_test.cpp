#include "model/surprise.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace prospect::model {
namespace {

constexpr int kWidth = 20, kHeight = 12;

std::vector<std::uint8_t> Grey(std::uint8_t level) {
  return std::vector<std::uint8_t>(kWidth * kHeight * 3, level);
}

// Draws a white square.
void Paint(std::vector<std::uint8_t>* picture, int left, int top, int side) {
  for (int y = top; y < top + side; ++y) {
    for (int x = left; x < left + side; ++x) {
      for (int c = 0; c < 3; ++c) (*picture)[(y * kWidth + x) * 3 + c] = 255;
    }
  }
}

TEST(Surprise, IsNoneOfEqualPictures) { EXPECT_EQ(Surprise(Grey(7), Grey(7), kWidth, kHeight), 0); }

TEST(Surprise, IsWholeWhereAPatchIsWhollyOther) {
  for (const auto& [left, top] : {std::pair{0, 0}, {14, 6}, {5, 3}}) {
    auto seen = Grey(0);
    Paint(&seen, left, top, 6);
    EXPECT_DOUBLE_EQ(Surprise(Grey(0), seen, kWidth, kHeight), 1) << left << " " << top;
    EXPECT_DOUBLE_EQ(Surprise(seen, Grey(0), kWidth, kHeight), 1);
  }
}

TEST(Surprise, TakesTheWorstPatchNotTheMean) {
  auto seen = Grey(0);
  Paint(&seen, 2, 2, 3);
  EXPECT_DOUBLE_EQ(Surprise(Grey(0), seen, kWidth, kHeight), 9.0 / 36);
  EXPECT_NEAR(Surprise(Grey(100), Grey(151), kWidth, kHeight), 0.2, 1e-9);
}

TEST(Surprise, RefusesOtherSizes) {
  EXPECT_THROW(Surprise(Grey(0), Grey(0), kWidth, kHeight + 1), std::invalid_argument);
  EXPECT_EQ(Surprise(std::vector<std::uint8_t>(75), std::vector<std::uint8_t>(75, 9), 5, 5), 0);
}

}  // namespace
}  // namespace prospect::model
