#include "model/refusal/scene_kind.h"

#include <gtest/gtest.h>

#include "tests/unit/model/refusal_sample.h"

namespace prospect::model {
namespace {

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

CalibrationSample Of(std::map<std::string, double> parameters) {
  CalibrationSample sample = SampleOf({Scene(0.4, 's', 'S')});
  sample.parameters = std::move(parameters);
  return sample;
}

TEST(NotCovered, ScenesOfTheCalibrationsOwnKindAreCovered) {
  const CalibrationSample towers_of_two = Of({{"samples", 30}, {"plan_length", 9}});
  EXPECT_EQ(NotCovered({towers_of_two}, {9, 4, 2}), "");
  EXPECT_EQ(NotCovered({towers_of_two}, {9, 0, 2}), "") << "nobody counted the objects";
  EXPECT_EQ(NotCovered({Of({{"plan_length", 3}, {"objects", 7}})}, {3, 7, 0}), "");
}

TEST(NotCovered, OthersAreNamed) {
  const CalibrationSample towers_of_two = Of({{"plan_length", 9}});
  const std::string higher = NotCovered({towers_of_two}, {18, 4, 3});
  EXPECT_TRUE(Holds(higher,
                    "calibrated on plans of 9 actions, not on towers of 3 (plans of 18 "
                    "actions), and may not have been trained for them"))
      << higher;
  EXPECT_TRUE(Holds(higher, "how often they succeed here is not known")) << higher;
  const CalibrationSample three_of_four = Of({{"plan_length", 3}});
  EXPECT_TRUE(Holds(NotCovered({three_of_four}, {5, 7, 0}),
                    "plans of 3 actions among 4 objects, not on plans of 5 actions among 7"));
  EXPECT_TRUE(Holds(NotCovered({three_of_four}, {3, 7, 0}),
                    "plans of 3 actions among 4 objects, not on plans of 3 actions among 7"));
}

TEST(NotCovered, WhatSaysNothingOfItsScenesRulesNothingOut) {
  EXPECT_EQ(NotCovered({}, {18, 4, 3}), "");
  EXPECT_EQ(NotCovered({Of({{"samples", 30}})}, {18, 4, 3}), "");
}

TEST(CoveringSample, IsThatOfTheScenesKind) {
  const std::vector<CalibrationSample> samples = {Of({{"plan_length", 3}}),
                                                  Of({{"plan_length", 5}, {"objects", 7}}),
                                                  Of({{"plan_length", 5}, {"objects", 6}})};
  EXPECT_EQ(CoveringSample(samples, {3, 4, 0}), &samples[0]);
  EXPECT_EQ(CoveringSample(samples, {5, 6, 0}), &samples[2]);
  EXPECT_EQ(CoveringSample(samples, {5, 0, 0}), &samples[1]) << "nobody counted the objects";
  EXPECT_EQ(CoveringSample(samples, {5, 5, 0}), nullptr);
  EXPECT_TRUE(
      Holds(NotCovered(samples, {4, 7, 0}),
            "plans of 3 actions among 4 objects and on plans of 5 actions among 7 objects "
            "and on plans of 5 actions among 6 objects, not on plans of 4 actions among 7"));
}

}  // namespace
}  // namespace prospect::model
