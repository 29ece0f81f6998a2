#include "agent/course.h"

#include <gtest/gtest.h>

namespace prospect::agent {
namespace {

Picture Plain(int side, std::uint8_t value) {
  return {side, side, std::vector<std::uint8_t>(static_cast<std::size_t>(side * side * 3), value)};
}

TEST(CourseTest, ComparesWithWhatTheLatestStepImagined) {
  Course course;
  EXPECT_EQ(course.SurpriseAfter(1, Plain(8, 0)), 0);
  course.Set({{"a", Plain(8, 0)}, {"b", Plain(8, 255)}, {"c", {}}});
  EXPECT_EQ(course.SurpriseAfter(0, Plain(8, 255)), 0) << "nothing was done yet";
  EXPECT_GT(course.SurpriseAfter(1, Plain(8, 255)), 0.3);
  EXPECT_EQ(course.SurpriseAfter(2, Plain(8, 255)), 0);
  EXPECT_EQ(course.SurpriseAfter(4, Plain(8, 255)), 0) << "beyond its end";
}

TEST(CourseTest, NamesTheFirstStepThatLacksAPicture) {
  Course course;
  EXPECT_EQ(course.Gap(8, 8), "");
  course.Set({{"a", Plain(8, 0)}, {"b", Plain(8, 0)}, {"c", {}}});
  EXPECT_EQ(course.Gap(8, 8), "") << "after the last step the plan is over";
  EXPECT_EQ(course.Gap(8, 9), "step 1, a") << "a picture of another size is none";
  course.Set({{"a", Plain(8, 0)}, {"b", {}}, {"c", Plain(8, 0)}});
  EXPECT_EQ(course.Gap(8, 8), "step 2, b");
}

}  // namespace
}  // namespace prospect::agent
