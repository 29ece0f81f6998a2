#include "sim/navigation/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/navigation/catalogue.h"
#include "sim/navigation/navigation_task.h"

namespace prospect::sim {
namespace {

TEST(NavigationScene, HoldsThePapersFourAndTheOthersAsked) {
  const NavigationParameters& p = TheNavigationParameters();
  std::set<int> others;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    for (int count = 4; count <= 7; ++count) {
      const NavigationScene scene = DrawScene(seed, count, p);
      ASSERT_EQ(scene.objects.size(), static_cast<std::size_t>(count));
      for (int i = 0; i < 4; ++i) EXPECT_EQ(scene.objects[i].kind, i);
      for (int i = 4; i < count; ++i) {
        EXPECT_LT(scene.objects[i - 1].kind, scene.objects[i].kind);
        if (count == 5) others.insert(scene.objects[i].kind);
      }
    }
  }
  EXPECT_EQ(others, (std::set<int>{4, 5, 6}));
}

TEST(NavigationScene, KeepsItsDistances) {
  const NavigationParameters& p = TheNavigationParameters();
  const std::vector<ObjectKind>& kinds = ObjectCatalogue();
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const NavigationScene scene = DrawScene(seed, 7, p);
    for (const PlacedObject& a : scene.objects) {
      EXPECT_GE(DistanceToHull(a, scene.start), p.start_gap);
      for (const PlacedObject& b : scene.objects) {
        if (a.kind >= b.kind) continue;
        EXPECT_GE(Distance(kinds[a.kind].footprint, a.pose, kinds[b.kind].footprint, b.pose),
                  p.object_gap);
      }
    }
    EXPECT_NEAR(scene.light, 1.0, p.light_range);
  }
}

TEST(NavigationScene, IsAFunctionOfItsSeed) {
  const NavigationParameters& p = TheNavigationParameters();
  EXPECT_TRUE(DrawScene(5, 6, p) == DrawScene(5, 6, p));
  EXPECT_FALSE(DrawScene(5, 6, p) == DrawScene(6, 6, p));
}

TEST(NavigationScene, TheRobotCoversFortyPixels) {
  NavigationTask task(TaskOptions{});
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    task.Reset(seed);
    EXPECT_GE(task.CountRobotPixels(64, 64), 40) << "seed " << seed;
  }
}

// Augmentation by the eight turns and mirrorings of a square relies on it.
TEST(NavigationScene, TheGroundHasTheSymmetriesOfASquare) {
  for (double x = -3.8; x < 3.8; x += 0.171) {
    for (double y = -3.8; y < 3.8; y += 0.173) {
      const Color color = GroundColorAt(x, y, 3.84);
      EXPECT_EQ(color, GroundColorAt(-x, y, 3.84));
      EXPECT_EQ(color, GroundColorAt(y, x, 3.84));
    }
  }
}

}  // namespace
}  // namespace prospect::sim
