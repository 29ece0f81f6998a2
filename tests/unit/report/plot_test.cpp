#include "report/plot.h"

#include <gtest/gtest.h>

#include "base/disk_error.h"
#include "report/scaling_plot.h"
#include "report/shift_plot.h"
#include "tests/unit/model/test_folder.h"
#include "tests/unit/report/ink.h"
#include "tests/unit/report/png_size.h"

namespace prospect::report {
namespace {

using model::TestFolder;
using nlohmann::json;

TEST(Axis, CutsToItsEndsAndCountsDoublings) {
  const Axis linear{10, 20, Axis::Scale::kLinear};
  EXPECT_DOUBLE_EQ(linear.Share(15), 0.5);
  EXPECT_DOUBLE_EQ(linear.Share(0), 0);
  EXPECT_DOUBLE_EQ(linear.Share(99), 1);
  const Axis doubling{1, 16, Axis::Scale::kLogarithmic};
  EXPECT_DOUBLE_EQ(doubling.Share(4), 0.5);
  EXPECT_DOUBLE_EQ(doubling.Share(0), 0);
}

TEST(Plot, UpIsMoreAndTicksStandBesideIt) {
  Canvas canvas(300);
  Plot plot(&canvas, 80, 20, 200, 100, {}, {0, 10, Axis::Scale::kLinear});
  EXPECT_EQ(plot.X(0), 80);
  EXPECT_EQ(plot.X(1), 280);
  EXPECT_EQ(plot.Y(0), 120);
  EXPECT_EQ(plot.Y(10), 20);
  plot.TickY(5, "5");
  plot.TickX(0.5, "0.5");
  const Ink ink = InkOf(canvas.Cut(200));
  EXPECT_LT(ink.left, 80);
  EXPECT_GT(ink.bottom, 120);
  EXPECT_LE(ink.bottom, 120 + kPlotBelow);
}

json Row(int workers, double rate) {
  return {{"workers", workers}, {"rollouts_per_s", rate}, {"mean_batch", 3.2}};
}

TEST(ScalingPlot, DrawsOneRowAndMany) {
  const TestFolder folder;
  WriteScalingPlot(folder / "one.png", json::array({Row(1, 100)}), "one");
  WriteScalingPlot(folder / "many.png", {Row(1, 100), Row(2, 0), Row(4, 900)}, "many");
  EXPECT_GE(PngSize(folder / "one.png").height, 400u);
  EXPECT_EQ(PngSize(folder / "many.png").width, PngSize(folder / "one.png").width);
  EXPECT_THROW(WriteScalingPlot(folder / "none/one.png", json::array({Row(1, 1)}), ""),
               base::DiskError);
}

json Point(const std::string& factor, int strength, int solved) {
  return {{"factor", factor}, {"strength", strength},  {"amount", 0.5}, {"scenes", 10},
          {"solved", solved}, {"failed", 10 - solved}, {"refused", 0}};
}

TEST(ShiftPlot, HasAPanelAFactor) {
  const TestFolder folder;
  json one = {{"scenes", 10}, {"points", {Point("", 0, 9), Point("light", 1, 5)}}};
  json many = one;
  for (const char* factor : {"camera", "hue", "noise", "shadow", "glare"})
    for (int strength = 1; strength <= 4; ++strength)
      many["points"].push_back(Point(factor, strength, strength));
  WriteShiftPlot(folder / "one.png", one, "shifts");
  WriteShiftPlot(folder / "many.png", many, "shifts");
  EXPECT_GT(PngSize(folder / "many.png").width, PngSize(folder / "one.png").width);
  EXPECT_THROW(WriteShiftPlot(folder / "none/one.png", one, ""), base::DiskError);
}

}  // namespace
}  // namespace prospect::report
