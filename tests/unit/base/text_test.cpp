#include "base/text.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace prospect::base {
namespace {

TEST(Joined, PutsTheSeparatorBetween) {
  EXPECT_EQ(Joined(std::vector<std::string>{}), "");
  EXPECT_EQ(Joined(std::set<std::string>{"red"}), "red");
  EXPECT_EQ(Joined(std::vector<std::string>{"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(Joined(std::vector<const char*>{"", "b"}, "."), ".b");
}

}  // namespace
}  // namespace prospect::base
