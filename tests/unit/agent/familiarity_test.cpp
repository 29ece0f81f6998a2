#include "agent/familiarity.h"

#include <gtest/gtest.h>

namespace prospect::agent {
namespace {

constexpr model::Novelty kForeign{0.002, 0.051, 0.02, 3.25, 1.2, 1.0, 1.3};

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

}  // namespace
}  // namespace prospect::agent
