#include "report/canvas.h"

#include <gtest/gtest.h>

#include "tests/unit/report/ink.h"

namespace prospect::report {
namespace {

TEST(Canvas, RepeatsEachPixelOfAPicture) {
  const sim::Image two{2, 1, {10, 20, 30, 40, 50, 60}};
  Canvas canvas(20);
  canvas.Picture(5, 4, two, 3);
  const sim::Image image = canvas.Cut(12);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 20; ++x) {
      const bool inside = x >= 5 && x < 11 && y >= 4 && y < 7;
      const int red = image.rgb[(static_cast<std::size_t>(y) * 20 + x) * 3];
      EXPECT_EQ(red, inside ? (x < 8 ? 10 : 40) : 255) << x << "," << y;
    }
  }
}

TEST(Canvas, ParagraphsKeepToTheirWidthAndGrowThePaper) {
  Canvas canvas(400);
  std::string text;
  for (int i = 0; i < 200; ++i) text += "word ";
  const int below = canvas.Paragraph(50, 10, 300, text, kBodyStyle);
  const sim::Image image = canvas.Cut(below);
  EXPECT_EQ(image.height, below);
  const Ink ink = InkOf(image);
  EXPECT_GE(ink.left, 49);
  EXPECT_LE(ink.right, 352);
  EXPECT_GT(ink.bottom, 400);  // twenty lines and more
}

TEST(Canvas, TextUpwardsStandsOnItsEnd) {
  Canvas canvas(200);
  canvas.TextUpwards(20, 100, "observed frequency", kBodyStyle);
  const Ink ink = InkOf(canvas.Cut(200));
  EXPECT_GT(ink.bottom - ink.top, 3 * (ink.right - ink.left));
  EXPECT_NEAR((ink.bottom + ink.top) / 2, 100, 4);
}

TEST(Canvas, TextEndsWhereItIsTold) {
  Canvas canvas(200);
  canvas.EndingAt(150, 10, "100 %", kBodyStyle);
  const Ink ink = InkOf(canvas.Cut(40));
  EXPECT_NEAR(ink.right, 150, 3);
  EXPECT_LT(ink.left, 130);
}

TEST(Canvas, FramedPicturesKeepTheirShape) {
  Canvas canvas(200);
  canvas.Framed(10, 10, 100, Plain(40, 20, 90), kBad);
  const Ink wide = InkOf(canvas.Cut(150));
  EXPECT_EQ(wide.right - wide.left + 1, 100 + 2 * 2) << "with the frame around it";
  EXPECT_EQ(wide.bottom - wide.top + 1, 50 + 2 * 2);
  Canvas other(200);
  other.Framed(10, 10, 100, {}, kBad);
  const sim::Image none = other.Cut(150);
  EXPECT_EQ(InkOf(none).bottom - InkOf(none).top + 1, 100 + 2 * 2) << "none is a square";
  EXPECT_EQ(none.rgb[(60 * 200 + 60) * 3], kPale.r);
}

TEST(Canvas, RowsHoldAboutAsMany) {
  EXPECT_EQ(Canvas::PerRow(3, 100, 0), 3);
  EXPECT_EQ(Canvas::PerRow(20, 100, 0), 10) << "ten and ten, not nineteen and one";
  EXPECT_EQ(Canvas::PerRow(5, 5000, 0), 1);
  EXPECT_EQ(Canvas::PerRow(0, 100, 0), 1);
}

}  // namespace
}  // namespace prospect::report
