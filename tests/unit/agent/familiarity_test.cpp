#include "agent/familiarity.h"

#include <gtest/gtest.h>

namespace prospect::agent {
namespace {

constexpr model::Novelty kForeign{0.002, 0.051, 0.02, 3.25, 1.2, 1.0, 1.3};

Picture Plain(int width, int height, std::uint8_t value) {
  Picture picture{width, height, {}};
  picture.rgb.assign(static_cast<std::size_t>(width) * height * 3, value);
  return picture;
}

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Familiarity, IsForeignBelowTheLevel) {
  Familiarity familiarity;
  familiarity.novelty = kForeign;
  familiarity.level = 0.01;
  EXPECT_TRUE(familiarity.foreign());
  EXPECT_TRUE(Holds(FamiliaritySentence(familiarity), "It is unlike what the networks"));
  EXPECT_TRUE(Holds(FamiliaritySentence(familiarity), "error 0.051"));
  familiarity.level = 0.002;
  EXPECT_FALSE(familiarity.foreign());
  familiarity.novelty.p = 0.43;
  EXPECT_EQ(FamiliaritySentence(familiarity), "The picture is like known ones (p 0.43).");
}

// Light apart: a picture of half the brightness differs nowhere.
TEST(DifferenceMap, ShowsWhereARedrawingDiffers) {
  Picture seen = Plain(4, 4, 50), redrawn = Plain(4, 4, 100);
  const Picture same = DifferenceMap(seen, redrawn);
  ASSERT_EQ(same.rgb.size(), 48u);
  for (const int value : same.rgb) EXPECT_EQ(value, 0);
  redrawn.rgb[3 * 5] = redrawn.rgb[3 * 5 + 1] = redrawn.rgb[3 * 5 + 2] = 250;
  const Picture map = DifferenceMap(seen, redrawn);
  EXPECT_EQ(map.rgb[3 * 5], 255);
  EXPECT_LT(map.rgb[0], 130);
  EXPECT_TRUE(DifferenceMap(seen, {}).empty());
  EXPECT_TRUE(DifferenceMap({}, redrawn).empty());
  EXPECT_TRUE(DifferenceMap(seen, Plain(2, 8, 1)).empty());
}

}  // namespace
}  // namespace prospect::agent
