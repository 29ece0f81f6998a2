#include "sim/camera.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace prospect::sim {
namespace {

Color Grey(double, double) { return Color(0.5f, 0.5f, 0.5f); }

std::array<int, 3> Pixel(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.rgb[(static_cast<std::size_t>(y) * image.width + x) * 3];
  return {p[0], p[1], p[2]};
}

Eigen::Isometry3d At(double x, double y, double yaw = 0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, 0);
  pose.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

const AerialView kView{10.0, 4.0};  // 64 pixels see 8 m: an eighth of a metre each

VisualBody Slab(float size_x, float size_y) {  // flat, so that perspective moves nothing
  return {Box({0, 0, 0}, {size_x, size_y, 0.002f}, Color(1, 0, 0))};
}

TEST(AerialCamera, EmptyGroundHasItsColourTimesTheLight) {
  AerialCamera camera(kView, Grey, {}, {});
  const Image image = camera.Render({}, 1.0, 64, 64);
  ASSERT_EQ(image.rgb.size(), 64u * 64 * 3);
  EXPECT_EQ(Pixel(image, 5, 60), (std::array<int, 3>{128, 128, 128}));
  EXPECT_EQ(Pixel(camera.Render({}, 1.1, 64, 64), 5, 60), (std::array<int, 3>{140, 140, 140}));
}

TEST(AerialCamera, RightIsXAndUpIsY) {
  AerialCamera camera(kView, Grey, {}, {Slab(1, 1)});
  const Image image = camera.Render({At(2, 3)}, 1.0, 64, 64);
  EXPECT_EQ(Pixel(image, 48, 8), (std::array<int, 3>{255, 0, 0}));
  EXPECT_EQ(Pixel(image, 16, 8), (std::array<int, 3>{128, 128, 128}));
  EXPECT_EQ(Pixel(image, 48, 56), (std::array<int, 3>{128, 128, 128}));
}

TEST(AerialCamera, CountsTheCoveredPixels) {
  AerialCamera camera(kView, Grey, {}, {Slab(1, 0.5f)});
  EXPECT_EQ(camera.CountMovingPixels({At(0, 0)}, 64, 64), 8 * 4);
  EXPECT_NEAR(camera.CountMovingPixels({At(1.03, -2.01, 0.7)}, 64, 64), 32, 5);
}

TEST(AerialCamera, StillThingsHideWhatIsBelow) {
  const VisualBody roof = {Box({0, 0, 2}, {2, 2, 0.1f}, Color(0, 0, 1))};
  AerialCamera camera(kView, Grey, roof, {Slab(0.5f, 0.5f)});
  EXPECT_EQ(camera.CountMovingPixels({At(0, 0)}, 64, 64), 0);
  EXPECT_EQ(Pixel(camera.Render({At(0, 0)}, 1.0, 64, 64), 32, 32), (std::array<int, 3>{0, 0, 255}));
}

// Only pixels near a moving body are traced again: the picture must equal one that is made from
// nothing.
TEST(AerialCamera, AMovedBodyLeavesNoTrace) {
  const VisualBody still = {Cylinder({1, 1, 0.5f}, 0.4f, 1, Color(0, 0, 1))};
  const VisualBody tall = {Box({0.2f, 0, 0.5f}, {1, 0.5f, 1}, Color(1, 1, 0))};
  AerialCamera used(kView, Grey, still, {tall});
  for (int i = 0; i < 30; ++i) used.Render({At(-3.5 + 0.2 * i, 0.1 * i, i)}, 1.0, 64, 64);
  for (const auto& pose : {At(0.9, 0.6, 0.4), At(-3.9, 3.9, 2), At(4.5, -4, 1)}) {
    AerialCamera fresh(kView, Grey, still, {tall});
    const Image one = used.Render({pose}, 0.97, 64, 64);
    const Image other = fresh.Render({pose}, 0.97, 64, 64);
    EXPECT_EQ(one.rgb, other.rgb);
  }
}

// The same, against an honest whole rendering: the moving body made part of the still scene.
TEST(AerialCamera, AMovingBodyLooksLikeAStillOne) {
  const VisualBody body = {Box({0, 0, 0.3f}, {1, 0.6f, 0.6f}, Color(1, 1, 0)),
                           Cylinder({0.3f, 0, 0.7f}, 0.2f, 0.3f, Color(0, 1, 0))};
  AerialCamera moving(kView, Grey, {}, {body});
  AerialCamera still(kView, Grey, Placed(body, 2.3, -1.7, 0.5), {});
  const Image a = moving.Render({At(2.3, -1.7, 0.5)}, 1.0, 64, 64);
  const Image b = still.Render({}, 1.0, 64, 64);
  int different = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) different += std::abs(a.rgb[i] - b.rgb[i]) > 30;
  EXPECT_LE(different, 6);  // rounding may turn a sample on an edge
}

TEST(AerialCamera, RefusesBadSizesAndPoses) {
  AerialCamera camera(kView, Grey, {}, {Slab(1, 1)});
  EXPECT_THROW(camera.Render({At(0, 0)}, 1.0, 0, 64), std::invalid_argument);
  EXPECT_THROW(camera.Render({At(0, 0)}, 1.0, 64, 5000), std::invalid_argument);
  EXPECT_THROW(camera.Render({}, 1.0, 64, 64), std::invalid_argument);
}

}  // namespace
}  // namespace prospect::sim
