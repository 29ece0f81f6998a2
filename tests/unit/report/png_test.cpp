#include "report/png.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "base/disk_error.h"
#include "report/difference_map.h"
#include "report/image_edit.h"
#include "tests/unit/model/test_folder.h"
#include "tests/unit/report/ink.h"
#include "tests/unit/report/png_size.h"

namespace prospect::report {
namespace {

sim::Image Checker() { return {2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9}}; }

TEST(Png, WritesASignedFileOfThePicturesSize) {
  const model::TestFolder folder;
  WritePng(folder / "a.png", Plain(5, 3, 7));
  const auto [width, height] = PngSize(folder / "a.png");
  EXPECT_EQ(width, 5u);
  EXPECT_EQ(height, 3u);
  EXPECT_EQ(EncodePng(Checker()).substr(1, 3), "PNG");
}

TEST(Png, NamesTheFileItCannotWrite) {
  try {
    WritePng("/nonexistent/folder/a.png", Checker());
    FAIL() << "wrote into a folder that does not exist";
  } catch (const base::DiskError& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/folder/a.png"), std::string::npos);
  }
}

TEST(Png, APictureWithoutPixelsIsRefused) {
  EXPECT_THROW(EncodePng(sim::Image()), std::runtime_error);
}

TEST(ImageEdit, EnlargesByRepeating) {
  const sim::Image large = Enlarge(Checker(), 3);
  ASSERT_EQ(large.width, 6);
  EXPECT_EQ(large.rgb[(2 * 6 + 2) * 3], 255);      // still the first pixel
  EXPECT_EQ(large.rgb[(2 * 6 + 3) * 3 + 1], 255);  // the second
  EXPECT_EQ(large.rgb[(5 * 6 + 5) * 3], 9);
}

TEST(ImageEdit, ResizesSmoothlyAndKeepsColours) {
  sim::Image red = Plain(4, 4, 0);
  for (std::size_t i = 0; i < red.rgb.size(); i += 3) red.rgb[i] = 200;
  const sim::Image large = Resized(red, 9, 6);
  ASSERT_EQ(large.rgb.size(), 9u * 6 * 3);
  EXPECT_EQ(large.rgb[0], 200);
  EXPECT_EQ(large.rgb[2], 0);
}

TEST(ImageEdit, PastingCutsOffWhatLiesOutside) {
  sim::Image canvas = Plain(3, 3, 1);
  Paste(Checker(), 2, 2, &canvas);
  EXPECT_EQ(canvas.rgb[8 * 3], 255);
  Paste(Checker(), -1, -1, &canvas);
  EXPECT_EQ(canvas.rgb[0], 9);
  Paste(Checker(), 10, -10, &canvas);
  EXPECT_EQ(canvas.rgb[4 * 3], 1);
}

TEST(MeanAbsoluteError, IsAShareOfFullRange) {
  const sim::Image black{1, 2, {0, 0, 0, 0, 0, 0}};
  const sim::Image other{1, 2, {255, 0, 0, 51, 0, 0}};
  EXPECT_DOUBLE_EQ(MeanAbsoluteError(black, other), 1.2 / 6);
  EXPECT_DOUBLE_EQ(MeanAbsoluteError(other, other), 0);
}

// Light apart: a picture of half the brightness differs nowhere.
TEST(DifferenceMap, ShowsWhereARedrawingDiffers) {
  sim::Image seen = Plain(4, 4, 50), redrawn = Plain(4, 4, 100);
  const sim::Image same = DifferenceMap(seen, redrawn);
  ASSERT_EQ(same.rgb.size(), 48u);
  for (const int value : same.rgb) EXPECT_EQ(value, 0);
  redrawn.rgb[3 * 5] = redrawn.rgb[3 * 5 + 1] = redrawn.rgb[3 * 5 + 2] = 250;
  const sim::Image map = DifferenceMap(seen, redrawn);
  EXPECT_EQ(map.rgb[3 * 5], 255);
  EXPECT_LT(map.rgb[0], 130);
  EXPECT_TRUE(DifferenceMap(seen, {}).empty());
  EXPECT_TRUE(DifferenceMap({}, redrawn).empty());
  EXPECT_TRUE(DifferenceMap(seen, Plain(2, 8, 1)).empty());
}

}  // namespace
}  // namespace prospect::report
