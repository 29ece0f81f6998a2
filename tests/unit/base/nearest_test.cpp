#include "base/nearest.h"

#include <gtest/gtest.h>

namespace prospect::base {
namespace {

const std::vector<std::string> kKnown{"demo", "explain",  "evaluate", "train",
                                      "run",  "--scenes", "--seed"};

TEST(NearestWord, OneLetterWrongLeftOutOrAdded) {
  EXPECT_EQ(NearestWord("trian", kKnown), "train");
  EXPECT_EQ(NearestWord("trin", kKnown), "train");
  EXPECT_EQ(NearestWord("evaluatte", kKnown), "evaluate");
  EXPECT_EQ(NearestWord("--sceens", kKnown), "--scenes");
}

TEST(NearestWord, SwappedNeighboursAreOneMistake) {
  EXPECT_EQ(NearestWord("dmeo", kKnown), "demo");
}

TEST(NearestWord, ABeginningIsNear) { EXPECT_EQ(NearestWord("expl", kKnown), "explain"); }

TEST(NearestWord, NothingIsNearToWhatIsFar) {
  EXPECT_EQ(NearestWord("juggle", kKnown), "");
  EXPECT_EQ(NearestWord("x", kKnown), "");
  EXPECT_EQ(NearestWord("", kKnown), "");
}

}  // namespace
}  // namespace prospect::base
