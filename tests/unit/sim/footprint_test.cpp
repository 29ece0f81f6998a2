#include "sim/footprint.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace prospect::sim {
namespace {

TEST(Footprint, DiscToDisc) {
  EXPECT_DOUBLE_EQ(Distance(Footprint::Disc(0.5), {0, 0, 0}, Footprint::Disc(1.0), {3, 4, 1}), 3.5);
  EXPECT_DOUBLE_EQ(Distance(Footprint::Disc(0.5), {0, 0, 0}, Footprint::Disc(1.0), {1, 0, 0}), 0.0);
}

TEST(Footprint, RectangleToDiscMeasuresToTheFace) {
  const Footprint hull = Footprint::Rectangle(2, 1);
  EXPECT_NEAR(Distance(hull, {0, 0, 0}, Footprint::Disc(0.25), {2, 0, 0}), 0.75, 1e-12);
  EXPECT_NEAR(Distance(hull, {0, 0, M_PI / 2}, Footprint::Disc(0.25), {2, 0, 0}), 1.25, 1e-12);
  EXPECT_NEAR(Distance(hull, {0, 0, 0}, Footprint::Disc(0.25), {4, 4.5, 0}), 5 - 0.25, 1e-12);
}

TEST(Footprint, ADiscInsideARectangleTouches) {
  EXPECT_EQ(Distance(Footprint::Rectangle(4, 4), {0, 0, 0}, Footprint::Disc(0.1), {0.5, 0.5, 0}),
            0);
}

TEST(Footprint, RectanglesCornerToFace) {
  const Footprint square = Footprint::Rectangle(2, 2);
  EXPECT_NEAR(Distance(square, {0, 0, 0}, square, {4, 0, M_PI / 4}), 3 - std::sqrt(2.0), 1e-12);
}

TEST(Footprint, CrossedRectanglesTouchThoughNoCornerIsInside) {
  const Footprint bar = Footprint::Rectangle(4, 0.2);
  EXPECT_EQ(Distance(bar, {0, 0, 0}, bar, {0, 0, M_PI / 2}), 0);
}

// A reference by brute force: the least distance between dense samples of both borders.
double SampledDistance(const Footprint& a, const Pose2& pa, const Footprint& b, const Pose2& pb) {
  const auto ca = a.Corners(pa);
  const auto cb = b.Corners(pb);
  double least = 1e9;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector2d p =
        ca[i / 100] + (i % 100) / 100.0 * (ca[(i / 100 + 1) % 4] - ca[i / 100]);
    for (int k = 0; k < 400; ++k) {
      const Eigen::Vector2d q =
          cb[k / 100] + (k % 100) / 100.0 * (cb[(k / 100 + 1) % 4] - cb[k / 100]);
      least = std::min(least, (p - q).norm());
    }
  }
  return least;
}

TEST(Footprint, AgreesWithSamplingAndIsSymmetric) {
  base::Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Footprint a = Footprint::Rectangle(random.Uniform(0.2, 2), random.Uniform(0.2, 2));
    const Footprint b = Footprint::Rectangle(random.Uniform(0.2, 2), random.Uniform(0.2, 2));
    const Pose2 pa{random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-3, 3)};
    const Pose2 pb{random.Uniform(2, 4), random.Uniform(2, 4), random.Uniform(-3, 3)};
    const double distance = Distance(a, pa, b, pb);
    EXPECT_NEAR(distance, Distance(b, pb, a, pa), 1e-12);
    EXPECT_NEAR(distance, SampledDistance(a, pa, b, pb), 0.03);
  }
}

TEST(Footprint, WrapsAngles) {
  EXPECT_NEAR(WrapAngle(3 * M_PI / 2), -M_PI / 2, 1e-12);
  EXPECT_NEAR(WrapAngle(-3 * M_PI / 2), M_PI / 2, 1e-12);
  EXPECT_NEAR(WrapAngle(-M_PI), M_PI, 1e-12);
  EXPECT_NEAR(WrapAngle(100 * M_PI + 0.25), 0.25, 1e-9);
}

}  // namespace
}  // namespace prospect::sim
