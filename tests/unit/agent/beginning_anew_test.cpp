// Plans that are lost on the way.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "agent/episode.h"
#include "tests/unit/agent/scripted.h"

namespace prospect::agent {
namespace {

// Pick up, back off, put down; after backing off one may also pick up again.
TaskView PickTask() {
  TaskView task;
  task.name = "picks";
  task.actions = {"pick", "back_off", "put"};
  task.words = {{"pick", "block"}, {"back_off", "block"}, {"put", "block"}};
  task.rules.num_actions = 3;
  task.rules.plan_length = 3;
  task.rules.repeats_allowed = true;
  task.rules.successors = {{1}, {0, 2}, {0}, {0}};
  return task;
}

class BeginningAnewTest : public ::testing::Test {
 protected:
  BeginningAnewTest() {
    options_.novelty = 0;
    world_.view = PickTask();
    world_.scene->present = {true, true, true};
    world_.length = 5;
  }

  EpisodeRecord Run() {
    Listener nobody;
    return Episode(world_, &mind_, options_, nobody).Run();
  }

  Script script_;
  ScriptedWorld world_{script_};
  ScriptedMind mind_{script_};
  EpisodeOptions options_;
};

// The mind imagined black pictures; after backing off the camera shows a white one.
TEST_F(BeginningAnewTest, ASurpriseBeginsThePlanAnew) {
  world_.shades = {{2, 255}};
  mind_.plans = {PlanOf({0, 1, 2}), PlanOf({1, 2}),      PlanOf({2}),
                 PlanOf({0, 1, 2}), PlanOf({1, 2}, 0.8), PlanOf({2}, 0.8)};
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "solved") << record.reason;
  EXPECT_EQ(world_.carried_out, (std::vector<int>{0, 1, 0, 1, 2}));
  const SearchRecord& anew = record.searches.at(2);
  EXPECT_EQ(anew.kind, planner::NextStep::Kind::kAnew);
  EXPECT_GT(anew.surprise, 0.4);
  EXPECT_EQ(anew.note.rfind("begins anew: a patch of the picture differs by", 0), 0u) << anew.note;
  EXPECT_EQ(anew.steps.size(), 3u) << "a whole plan";
  EXPECT_EQ(mind_.questions.at(3).rules.plan_length, 4) << "as long as is left of two";
  EXPECT_EQ(mind_.questions.at(3).executed, (planner::Path{1}));
  EXPECT_EQ(record.rollouts, 6 * 30) << "the search that decided nothing, too";
}

TEST_F(BeginningAnewTest, NotMoreOftenThanAllowed) {
  options_.retries = 0;
  world_.shades = {{2, 255}};
  world_.length = 3;
  mind_.plans = {PlanOf({0, 1, 2}), PlanOf({1, 2}), PlanOf({2})};
  EXPECT_EQ(Run().outcome, "solved");
  EXPECT_EQ(std::count(script_.calls.begin(), script_.calls.end(), "imagine"), 0)
      << "no picture is needed then";
}

TEST_F(BeginningAnewTest, WhatScoresTooLittleIsBegunAnew) {
  mind_.plans = {PlanOf({0, 1, 2}), PlanOf({1, 2}),      PlanOf({2}, 0.3),
                 PlanOf({0, 1, 2}), PlanOf({1, 2}, 0.8), PlanOf({2}, 0.8)};
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "solved");
  EXPECT_EQ(record.searches.at(2).note, "begins anew: going on scored 0.30");
}

// On the way to where one may begin anew the rest of the plan is carried on.
TEST_F(BeginningAnewTest, ALostPlanIsCarriedOnToThere) {
  mind_.plans = {PlanOf({0, 1, 2}), Refusal("it slipped"), Refusal("it slipped"),
                 PlanOf({0, 1, 2}), PlanOf({1, 2}, 0.8),   PlanOf({2}, 0.8)};
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "solved") << record.reason;
  EXPECT_EQ(world_.carried_out, (std::vector<int>{0, 1, 0, 1, 2}));
  EXPECT_EQ(record.searches.at(1).kind, planner::NextStep::Kind::kCarryOn);
  EXPECT_EQ(record.searches.at(1).note,
            "the plan is lost (it slipped): on to where it can begin anew");
  EXPECT_TRUE(record.searches.at(1).steps.empty());
}

// What was imagined tells a plan that goes wrong: without it nothing is begun.
TEST_F(BeginningAnewTest, WithoutPicturesNothingIsDone) {
  mind_.draws = false;
  mind_.plans = {PlanOf({0, 1, 2})};
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "refused");
  EXPECT_NE(record.reason.find("after step 1, pick, so nobody could tell"), std::string::npos)
      << record.reason;
  EXPECT_TRUE(world_.carried_out.empty());

  options_.surprise = 1;
  world_.length = 3;
  mind_.plans = {PlanOf({0, 1, 2}), PlanOf({1, 2}), PlanOf({2})};
  EXPECT_EQ(Run().outcome, "solved");
}

}  // namespace
}  // namespace prospect::agent
