#include "services/executive/familiarity.h"

#include <gtest/gtest.h>

#include "services/binding/novelty_messages.h"
#include "services/executive/explanation_page.h"

namespace prospect::services {
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

TEST(NoveltyMessages, ComeBackAsTheyWent) {
  const model::Novelty back = FromMessage(ToMessage(kForeign));
  EXPECT_EQ(back.p, kForeign.p);
  EXPECT_EQ(back.error, kForeign.error);
  EXPECT_EQ(back.error_limit, kForeign.error_limit);
  EXPECT_EQ(back.residual, kForeign.residual);
  EXPECT_EQ(back.residual_limit, kForeign.residual_limit);
  EXPECT_EQ(back.state, kForeign.state);
  EXPECT_EQ(back.state_limit, kForeign.state_limit);
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

TEST(ExplanationPageTest, TellsWhetherThePictureIsKnown) {
  Explanation explanation;
  explanation.reason = model::NoveltyRefusal(kForeign);
  explanation.ended_by = "samples";
  EXPECT_FALSE(Holds(ExplanationPage(explanation), "known ones"));
  Familiarity familiarity;
  familiarity.novelty = kForeign;
  familiarity.seen = familiarity.redrawn = Plain(2, 2, 9);
  explanation.familiarity = familiarity;
  const std::string page = ExplanationPage(explanation);
  EXPECT_TRUE(Holds(page, "The picture is unlike known ones"));
  EXPECT_TRUE(Holds(page, "99 % of known pictures stay below 0.020"));
  if (PROSPECT_PICTURES) {
    EXPECT_TRUE(Holds(page, "Where the two differ"));
  }
  explanation.familiarity->novelty.p = 0.5;
  EXPECT_TRUE(Holds(ExplanationPage(explanation), "The picture is like known ones (p 0.5)."));
}

}  // namespace
}  // namespace prospect::services
