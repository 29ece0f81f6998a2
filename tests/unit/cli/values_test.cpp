#include "cli/values.h"

#include <gtest/gtest.h>

namespace prospect::cli {
namespace {

// What a check says of a value; empty: nothing.
std::string Said(const CLI::Validator& check, std::string value) { return check(value); }

TEST(Values, WholeNumbersAreDecimalAndInRange) {
  EXPECT_EQ(Said(Whole(2, 8), "8"), "");
  EXPECT_EQ(Said(Whole(2, 8), "1"), "wants a whole number from 2 to 8, not '1'");
  for (const char* wrong : {"9", "0x4", "4.0", "", " 4", "four", "99999999999999999999"})
    EXPECT_NE(Said(Whole(2, 8), wrong), "") << wrong;
}

TEST(Values, LeadingZerosDoNotMakeANumberOctal) {
  std::string value = "010";
  EXPECT_EQ(Whole(0, 100)(value), "");
  EXPECT_EQ(value, "10");
}

TEST(Values, RealNumbers) {
  for (const char* right : {"0", "1", "0.5", ".5", "1e-3"}) EXPECT_EQ(Said(Real(0, 1), right), "");
  for (const char* wrong : {"x", "", "1.5", "-0.1", "0.5x", "nan"})
    EXPECT_NE(Said(Real(0, 1), wrong), "") << wrong;
}

TEST(Values, SharesLieBetween) {
  EXPECT_EQ(Said(Share(), "0.05"), "");
  for (const char* wrong : {"0", "1", "5", "x"}) EXPECT_NE(Said(Share(), wrong), "") << wrong;
}

TEST(Values, PartsAreCountedFromOne) {
  for (const char* right : {"1/1", "1/8", "8/8", "1000/1000"})
    EXPECT_EQ(Said(PartOfParts(), right), "");
  for (const char* wrong : {"0/8", "9/8", "-1/8", "1/1001", "1", "1/", "/8", "1/8x", "1 / 8", ""})
    EXPECT_NE(Said(PartOfParts(), wrong), "") << wrong;
}

TEST(Values, GoalsAreReadByThePlanner) {
  EXPECT_EQ(Said(Goal(), "on(red,blue), visited(barrel)"), "");
  EXPECT_NE(Said(Goal(), "on(red"), "");
  EXPECT_NE(Said(Goal(), ""), "");
}

TEST(Values, Policies) {
  for (const char* right : {"search", "expert", "collect", "plan:0", "plan:0,2,11"})
    EXPECT_EQ(Said(Policy(), right), "") << right;
  for (const char* wrong : {"best", "plan:", "plan:x", "plan:0,", "plan:-1", "plan:0 1"})
    EXPECT_NE(Said(Policy(), wrong), "") << wrong;
}

TEST(Values, PlansOfNames) {
  for (const char* right : {"align(green)", "align(green), grasp(green)", "jump", "on(a,b),c"})
    EXPECT_EQ(Said(PlanOfNames(), right), "") << right;
  for (const char* wrong : {"", "align(green", "align(green),", "align()", "(green)", "a(b)c"})
    EXPECT_NE(Said(PlanOfNames(), wrong), "") << wrong;
}

}  // namespace
}  // namespace prospect::cli
