#include "services/executive/familiarity.h"

#include <gtest/gtest.h>

#include "services/binding/novelty_messages.h"

namespace prospect::services {
namespace {

constexpr model::Novelty kForeign{0.002, 0.051, 0.02, 3.25, 1.2, 1.0, 1.3};

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(NoveltyText, ComesBackAsItWent) {
  const auto back = NoveltyFrom(NoveltyText(kForeign));
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->p, kForeign.p, 1e-9);
  EXPECT_NEAR(back->error, kForeign.error, 1e-9);
  EXPECT_NEAR(back->error_limit, kForeign.error_limit, 1e-9);
  EXPECT_NEAR(back->residual, kForeign.residual, 1e-9);
  EXPECT_NEAR(back->residual_limit, kForeign.residual_limit, 1e-9);
  EXPECT_NEAR(back->state, kForeign.state, 1e-9);
  EXPECT_NEAR(back->state_limit, kForeign.state_limit, 1e-9);
}

TEST(NoveltyText, WhatIsNoneIsRefused) {
  const std::string text = NoveltyText(kForeign);
  for (const std::string& bad :
       {std::string(), std::string("this search is not held here"), text + " more=1",
        text.substr(0, text.size() / 2), "x" + text, std::string("p=nan") + text.substr(7),
        std::string("p=2") + text.substr(7), std::string("p=-1") + text.substr(7),
        std::string("p=0.1x") + text.substr(7)}) {
    EXPECT_FALSE(NoveltyFrom(bad)) << bad;
  }
  ASSERT_EQ(text.substr(0, 7), "p=0.002") << "the cases above replace it";
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

}  // namespace
}  // namespace prospect::services
