#include "base/hash.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace prospect::base {
namespace {

// The values are stored in weights, data sets and recordings.
TEST(Hash, IsFnv1a) {
  EXPECT_EQ(HashText(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(HashText("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(HashText("foobar"), 0x85944171f73967e8ULL);
  EXPECT_EQ(HashText("abc"), 0xe71fa2190541574bULL);
  const unsigned char high[] = {0xff, 0x00, 0x80};
  EXPECT_EQ(HashBytes(high, 3), HashText(std::string("\xff\0\x80", 3)));
}

TEST(Hash, GoesOnWhereItStopped) { EXPECT_EQ(HashText("c", HashText("ab")), HashText("abc")); }

TEST(Hash, MixesAsSplitMix64DoesAndLosesNothing) {
  EXPECT_EQ(Mix64(0), 0xe220a8397b1dcdafULL);
  EXPECT_EQ(Mix64(1), 0x910a2dec89025cc1ULL);
  std::set<std::uint64_t> seen;
  for (std::uint64_t x = 0; x < 10000; ++x) seen.insert(Mix64(x));
  EXPECT_EQ(seen.size(), 10000u);
}

TEST(Hash, IsWrittenWithAllItsDigits) {
  EXPECT_EQ(HexText(0), "0000000000000000");
  EXPECT_EQ(HexText(0x7b4fc0cd3cc2c18eULL), "7b4fc0cd3cc2c18e");
}

}  // namespace
}  // namespace prospect::base
