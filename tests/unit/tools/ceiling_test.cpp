#include <gtest/gtest.h>

#include "tests/unit/sim/scripted_task.h"
#include "tools/ceiling/foretold.h"
#include "tools/ceiling/replay.h"
#include "tools/ceiling/spread.h"

namespace prospect::tools {
namespace {

TEST(Foretold, KnowingEverythingScoresOne) {
  const Scores scores = ScoresOf({{1, 1}, {0, 0}, {1, 1}});
  EXPECT_EQ(scores.moments, 3);
  EXPECT_DOUBLE_EQ(scores.accuracy, 1);
  EXPECT_DOUBLE_EQ(scores.balanced, 1);
  EXPECT_DOUBLE_EQ(scores.area_under_roc, 1);
  EXPECT_DOUBLE_EQ(scores.majority, 2.0 / 3);
}

// Two moments, each foretold as often as it comes true: by hand.
TEST(Foretold, WhatIsUncertainCannotBeKnown) {
  const Scores scores = ScoresOf({{0.8, 0.8}, {0.4, 0.4}});
  EXPECT_DOUBLE_EQ(scores.base_rate, 0.6);
  EXPECT_DOUBLE_EQ(scores.accuracy, 0.7) << "0.8 right of the first, 0.6 of the second";
  EXPECT_DOUBLE_EQ(scores.balanced, (0.8 / 1.2 + 0.6 / 0.8) / 2);
  // Of 1.2 x 0.8 pairs, 0.8 x 0.6 in order and 0.8 x 0.2 + 0.4 x 0.6 within a moment.
  EXPECT_DOUBLE_EQ(scores.area_under_roc, (0.48 + (0.16 + 0.24) / 2) / 0.96);
}

TEST(Foretold, AThresholdThatSuitsBetterThanAHalf) {
  const Scores scores = ScoresOf({{0.9, 1}, {0.7, 0}});
  EXPECT_DOUBLE_EQ(scores.balanced, 0.5);
  EXPECT_DOUBLE_EQ(scores.best_balanced, 1);
}

TEST(Foretold, OneOutcomeOnlyTellsNothing) {
  const Scores scores = ScoresOf({{1, 1}, {0.2, 1}});
  EXPECT_DOUBLE_EQ(scores.area_under_roc, 0.5);
  EXPECT_DOUBLE_EQ(scores.balanced, 0.5);
  EXPECT_EQ(ScoresOf({}).moments, 0);
}

Repetitions Sum(const Repetitions& r) {
  return {{r.first.runs + r.second.runs, r.first.came_true + r.second.came_true}, {}};
}

TEST(Replay, WhatIsCertainComesTrueEveryTime) {
  sim::ScriptedTask task([](const std::vector<int>&, std::uint64_t) { return std::string(); });
  const auto moment = Replay(task, 5, 1, 6);
  ASSERT_TRUE(moment);
  for (const Repetitions& r :
       {moment->value, moment->value_one, moment->done_one, moment->value_two, moment->done_two}) {
    EXPECT_EQ(r.first.runs, 3);
    EXPECT_EQ(r.second.runs, 3);
    EXPECT_EQ(Sum(r).first.came_true, 6);
  }
}

// The last action fails in about every second run, the others never: only that is uncertain, and
// after the trial's end nothing is.
TEST(Replay, OnlyTheFutureIsDrawnAnew) {
  sim::ScriptedTask task([](const std::vector<int>& path, std::uint64_t noise) {
    return path.size() == 3 && noise % 2 == 1 ? std::string("slipped") : std::string();
  });
  const auto moment = Replay(task, 4, 1, 40);
  ASSERT_TRUE(moment);
  EXPECT_EQ(Sum(moment->done_one).first.came_true, 40);
  for (const Repetitions& r : {moment->value, moment->value_one, moment->done_two}) {
    EXPECT_GT(Sum(r).first.came_true, 8);
    EXPECT_LT(Sum(r).first.came_true, 32);
  }
  const auto end = Replay(task, 4, 3, 10);
  ASSERT_TRUE(end);
  EXPECT_EQ(Sum(end->value).first.came_true, 10) << "trial 4 succeeded: that is known";
  EXPECT_EQ(Sum(end->done_one).first.runs, 0) << "nothing comes after";
  EXPECT_FALSE(Replay(task, 4, 4, 10)) << "no trial has four actions";
}

// A run that ends before the second action tells nothing of it.
TEST(Replay, CountsOnlyRunsThatComeSoFar) {
  sim::ScriptedTask task([](const std::vector<int>& path, std::uint64_t noise) {
    return path.size() == 1 && noise % 2 == 1 ? std::string("slipped") : std::string();
  });
  const auto moment = Replay(task, 4, 0, 40);
  ASSERT_TRUE(moment);
  EXPECT_EQ(Sum(moment->done_one).first.runs, 40);
  EXPECT_LT(Sum(moment->done_two).first.runs, 32);
  EXPECT_EQ(Sum(moment->done_two).first.came_true, Sum(moment->done_two).first.runs);
}

TEST(Spread, TheMedianErrsLeast) {
  const auto picture = [](std::uint8_t value) { return sim::Image{1, 1, {value, 0, 0}}; };
  const auto errors =
      ErrorsOf({picture(0), picture(0), picture(255)}, {picture(0), picture(51), picture(255)});
  ASSERT_TRUE(errors.known);
  EXPECT_DOUBLE_EQ(errors.foretold, (0 + 0.2 + 1) / 9) << "from 0, one of three numbers";
  EXPECT_DOUBLE_EQ(errors.in_itself, (3 * 0.2 + 2 * 0.8) / 18) << "from the upper median, 0.2";
  EXPECT_FALSE(ErrorsOf({picture(0)}, {}).known);
  EXPECT_THROW(ErrorsOf({picture(0)}, {{2, 1, {0, 0, 0, 0, 0, 0}}}), std::invalid_argument);
}

// Shows whether an action has failed.
class ShownTask : public sim::ScriptedTask {
 public:
  using sim::ScriptedTask::ScriptedTask;
  sim::Image Observe() override {
    const bool failed = progress().action_state == sim::ActionState::kFailed;
    return {1, 1, {static_cast<std::uint8_t>(failed ? 255 : 0), 0, 0}};
  }
};

TEST(Replay, PicturesDifferWhereActionsAreUncertain) {
  ShownTask task([](const std::vector<int>& path, std::uint64_t noise) {
    return path.size() == 3 && noise % 4 == 1 ? std::string("slipped") : std::string();
  });
  const auto moment = Replay(task, 4, 1, 40);
  ASSERT_TRUE(moment);
  ASSERT_TRUE(moment->pictures_one.known && moment->pictures_two.known);
  EXPECT_EQ(moment->pictures_one.in_itself, 0) << "the second action never fails";
  const Repetitions& done = moment->done_two;
  const double failed = 1 - Sum(done).first.came_true / 40.0;
  EXPECT_GT(failed, 0.05);
  EXPECT_NEAR(moment->pictures_two.in_itself, failed / 3, 1e-9) << "one of three numbers";
  EXPECT_NEAR(moment->pictures_two.foretold, (1 - done.second.came_true / 20.0) / 3, 1e-9);
}

}  // namespace
}  // namespace prospect::tools
