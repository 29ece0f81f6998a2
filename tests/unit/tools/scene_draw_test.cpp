#include "tools/evaluate/scene_draw.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace prospect::tools {
namespace {

// Every fifth scene is hopeless, every seventh doubtful, the others solvable.
sim::SceneClass Known(std::uint64_t seed) {
  if (seed % 5 == 0) return sim::SceneClass::kHopeless;
  return seed % 7 == 0 ? sim::SceneClass::kDoubtful : sim::SceneClass::kSolvable;
}

TEST(DrawScenes, TakesTheFirstOfEachClassInSeedOrder) {
  for (const int jobs : {1, 2}) {
    const auto drawn = DrawScenes({3, 4}, 2'000'001, jobs, [] { return ClassOf(Known); });
    EXPECT_EQ(drawn, (std::vector<std::uint64_t>{2'000'001, 2'000'002, 2'000'003, 2'000'005,
                                                 2'000'010, 2'000'015, 2'000'020}));
  }
}

TEST(DrawScenes, GoesOnUntilBothAreFull) {
  const auto drawn = DrawScenes({1, 30}, 2'000'001, 2, [] { return ClassOf(Known); });
  EXPECT_EQ(drawn.size(), 31u);
  EXPECT_EQ(drawn.back(), 2'000'150u);
}

TEST(DrawScenes, SaysSoWhenThereAreNotEnough) {
  const auto never = [] {
    return ClassOf([](std::uint64_t) { return sim::SceneClass::kSolvable; });
  };
  EXPECT_THROW(DrawScenes({1, 1}, 2'000'000, 1, never, 64), std::runtime_error);
  EXPECT_TRUE(DrawScenes({0, 0}, 2'000'000, 1, never, 64).empty());
}

}  // namespace
}  // namespace prospect::tools
