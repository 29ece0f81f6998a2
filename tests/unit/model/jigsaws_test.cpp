// The gestures of JIGSAWS.
#include <gtest/gtest.h>

#include "model/jigsaws/gestures.h"

namespace prospect::model::jigsaws {
namespace {

TEST(Gestures, NamesAndTasks) {
  EXPECT_EQ(GestureName(0), "G1");
  EXPECT_EQ(GestureName(14), "G15");
  EXPECT_TRUE(IsGestureTask("suturing"));
  EXPECT_TRUE(IsGestureTask("needle_passing"));
  EXPECT_FALSE(IsGestureTask("Suturing"));
  EXPECT_FALSE(IsGestureTask("stacking"));
  EXPECT_EQ(TaskOfFolder("Knot_Tying"), "knot_tying");
}

}  // namespace
}  // namespace prospect::model::jigsaws
