#include "report/page.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/disk_error.h"
#include "report/heat_map.h"
#include "report/strip.h"
#include "tests/unit/model/test_folder.h"
#include "tests/unit/report/ink.h"

namespace prospect::report {
namespace {

using model::TestFolder;

TEST(Page, CaptionIsInThePictureAndBesideIt) {
  const TestFolder folder;
  Canvas canvas(400);
  const int y = DrawHeading(&canvas, "Heading");
  const Page page = Finish(&canvas, y, "one.png", "What is to be seen.");
  EXPECT_GT(InkOf(page.picture).bottom, y + 14);
  WritePage(folder.path().string(), page);
  WriteCaptions(folder.path().string(), "About all.", {page});
  std::stringstream text;
  text << std::ifstream(folder / "captions.md").rdbuf();
  EXPECT_NE(text.str().find("About all."), std::string::npos);
  EXPECT_NE(text.str().find("one.png"), std::string::npos);
  EXPECT_NE(text.str().find("What is to be seen."), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "one.png"));
  EXPECT_THROW(WritePage(folder / "missing", page), base::DiskError);
  EXPECT_THROW(WriteCaptions(folder / "missing", "", {page}), base::DiskError);
}

double Lightness(const Color& c) { return 0.3 * c.r + 0.59 * c.g + 0.11 * c.b; }

TEST(HeatColor, GrowsLighterAndIsCutOutside) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_LT(Lightness(HeatColor(i / 100.0)), Lightness(HeatColor((i + 1) / 100.0))) << i;
  }
  EXPECT_EQ(HeatColor(-3).b, HeatColor(0).b);
  EXPECT_EQ(HeatColor(3).r, HeatColor(1).r);
}

TEST(HeatMap, RunsFromTheLowestToTheHighestOfAll) {
  const Range range = RangeOf({{2, 1, {0.25F, 0.5F}}, {2, 1, {0.125F, 0.3F}}});
  EXPECT_DOUBLE_EQ(range.low, 0.125);
  EXPECT_DOUBLE_EQ(range.high, 0.5);
  const sim::Image heat = HeatMap({2, 1, {0.125F, 0.5F}}, range);
  EXPECT_EQ(heat.rgb[0], HeatColor(0).r);
  EXPECT_EQ(heat.rgb[3], HeatColor(1).r);
}

TEST(Strips, LongVerdictsOfShortStripsDoNotTouch) {
  Strip strip;
  strip.heading = "Future 1";
  strip.cells = {{"1. one", Plain(64, 64, 90), {"V 0.50"}, false}};
  strip.verdict = "rejected: step 1 would not finish: f 0.02 < 0.10, and it is told at length";
  Canvas two(900), one(900);
  const int below = DrawStrips(&two, 0, {strip, strip});
  DrawStrips(&one, 0, {strip});
  const int right = InkOf(one.Cut(below)).right;
  const sim::Image both = two.Cut(below);
  bool gap = true;  // a column without ink right of the first
  for (int y = 0; y < below; ++y) gap = gap && IsPaper(both, right + 4, y);
  EXPECT_TRUE(gap);
  EXPECT_GT(InkOf(both).right, right + 128) << "the second stands beside the first";
}

}  // namespace
}  // namespace prospect::report
