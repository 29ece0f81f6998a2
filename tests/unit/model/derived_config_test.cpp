#include "model/training/derived_config.h"

#include <gtest/gtest.h>

namespace prospect::model {
namespace {

TEST(DerivedConfig, FitsTheTable) {
  const TrainConfig c = DerivedConfig({96, 48, 12, 2, 5000});
  EXPECT_EQ(c.network.image_width, 96);
  EXPECT_EQ(c.network.image_height, 48);
  EXPECT_EQ(c.network.num_actions, 12);
  EXPECT_EQ(c.linked_steps, 2) << "no longer chain than a plan";
  EXPECT_TRUE(c.heads_need_failures);
}

TEST(DerivedConfig, MoreActionsTakeMoreIterationsBetweenBounds) {
  const auto iterations = [](std::size_t segments) {
    return DerivedConfig({64, 64, 7, 4, segments}).transform_hidden.iterations;
  };
  EXPECT_LT(iterations(500), iterations(5000));
  EXPECT_GE(iterations(1), 100) << "from a handful, something is learned";
  EXPECT_EQ(iterations(10'000'000), iterations(1'000'000));
}

TEST(DerivedConfig, HeadsLearnAsLongAsTheirTableOfActionsTakes) {
  const TrainConfig c = DerivedConfig({64, 64, 12, 4, 5000});
  EXPECT_GE(2 * c.heads.iterations, c.transform_hidden.iterations)
      << "V and f that learned little call every plan good";
  EXPECT_EQ(c.precision, "float32");
}

TEST(DerivedConfig, IsValidForEverySizeOfATask) {
  for (const int side : {32, 64, 128, 256}) {
    for (const int actions : {1, 255}) {
      for (const int length : {1, 64}) {
        for (const std::size_t segments : {std::size_t{0}, std::size_t{1}, std::size_t{1} << 40})
          EXPECT_NO_THROW(Validate(DerivedConfig({side, 32, actions, length, segments})));
      }
    }
  }
}

TEST(Resolved, OnlyAutoDependsOnTheMachineAndOnlyOnTheCpu) {
  TrainConfig config;
  EXPECT_EQ(config.precision, "auto");
  EXPECT_EQ(Resolved(config, "cuda").precision, "float32");
  const std::string here = Resolved(config, "cpu").precision;
  EXPECT_TRUE(here == "float32" || here == "mixed") << here;
  for (const char* said : {"float32", "mixed"}) {
    config.precision = said;
    EXPECT_EQ(Resolved(config, "cpu").precision, said);
    EXPECT_EQ(Resolved(config, "cuda").precision, said);
  }
}

}  // namespace
}  // namespace prospect::model
