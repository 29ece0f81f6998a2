#include "base/number_format.h"

#include <gtest/gtest.h>

#include <limits>

namespace prospect::base {
namespace {

TEST(NumberFormat, IsThatOfPrintf) {
  EXPECT_EQ(Number("%.2f", 0.125), "0.12");
  EXPECT_EQ(Number("%.1f %%", 12.34), "12.3 %");
  EXPECT_EQ(Number("%+g", 2), "+2");
  EXPECT_EQ(Number("%.6f", -std::numeric_limits<double>::max()).size(), 317u);
}

TEST(NumberFormat, FixesDecimals) {
  EXPECT_EQ(Fixed(2.0 / 3, 3), "0.667");
  EXPECT_EQ(Fixed(-0.5, 0), "-0");
}

TEST(NumberFormat, TellsNumbersApart) {
  EXPECT_EQ(Apart(0.0316, 0.0320), "0.0316");
  EXPECT_EQ(Apart(0.0320, 0.0316), "0.0320");
  EXPECT_EQ(Apart(0.5, 0.7), "0.50");
  EXPECT_EQ(Apart(0.5, 0.5), "0.50") << "nothing tells them apart";
  EXPECT_EQ(Apart(0.1, 0.1 + 1e-9), "0.100000") << "six decimals are enough";
  EXPECT_EQ(Apart(0.5, 0.7, 3), "0.500");
  EXPECT_EQ(DigitsApart(0.1234, 0.1235), 4);
}

}  // namespace
}  // namespace prospect::base
