#include "model/surprise.h"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

namespace prospect::model {
namespace {

constexpr int kWidth = 20, kHeight = 12;

std::vector<std::uint8_t> Grey(std::uint8_t level) {
  return std::vector<std::uint8_t>(kWidth * kHeight * 3, level);
}

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour kWhite = {255, 255, 255}, kRed = {255, 0, 0}, kBlue = {0, 0, 255};

// Draws a square.
void Paint(std::vector<std::uint8_t>* picture, int left, int top, int side, const Colour& colour) {
  for (int y = top; y < top + side; ++y) {
    for (int x = left; x < left + side; ++x) {
      for (int c = 0; c < 3; ++c) (*picture)[(y * kWidth + x) * 3 + c] = colour[c];
    }
  }
}

// Of one picture that is white but for a red block and the other with `colour` in its place.
double OfABlock(const Colour& colour, int left = 5, int top = 3) {
  auto imagined = Grey(255), seen = Grey(255);
  Paint(&imagined, left, top, 6, kRed);
  Paint(&seen, left, top, 6, colour);
  const double surprise = Surprise(imagined, seen, kWidth, kHeight);
  EXPECT_DOUBLE_EQ(Surprise(seen, imagined, kWidth, kHeight), surprise);
  return surprise;
}

TEST(Surprise, IsNoneOfEqualPictures) { EXPECT_EQ(Surprise(Grey(7), Grey(7), kWidth, kHeight), 0); }

TEST(Surprise, IsMostWhereABlockIsMissing) {
  for (const auto& [left, top] : {std::pair{0, 0}, {14, 6}, {5, 3}})
    EXPECT_DOUBLE_EQ(OfABlock(kWhite, left, top), 5.0 / 6) << left << " " << top;
}

TEST(Surprise, IsLessWhereABlockHasAnotherColour) { EXPECT_DOUBLE_EQ(OfABlock(kBlue), 1.0 / 3); }

TEST(Surprise, TakesTheWorstPatchNotTheMean) {
  auto seen = Grey(0);
  Paint(&seen, 2, 2, 3, kWhite);
  EXPECT_DOUBLE_EQ(Surprise(Grey(0), seen, kWidth, kHeight), 9.0 / 36 / 2);
  EXPECT_NEAR(Surprise(Grey(100), Grey(151), kWidth, kHeight), 0.1, 1e-9);
}

TEST(Surprise, RefusesOtherSizes) {
  EXPECT_THROW(Surprise(Grey(0), Grey(0), kWidth, kHeight + 1), std::invalid_argument);
  EXPECT_EQ(Surprise(std::vector<std::uint8_t>(75), std::vector<std::uint8_t>(75, 9), 5, 5), 0);
}

}  // namespace
}  // namespace prospect::model
