#include "tools/evaluate/episode.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/task_factory.h"
#include "tools/evaluate/plan_outcomes.h"
#include "tools/evaluate/search_deciders.h"

namespace prospect::tools {
namespace {

constexpr std::uint64_t kFirstScene = 1'400'000;  // tuning scenes: never in a reported figure

TEST(RunEpisode, DoingNothingIsARefusal) {
  const auto task = sim::MakeTask("navigation");
  const auto nothing = MakeNothing();
  const EpisodeRecord record = RunEpisode(*task, *nothing, kFirstScene, 0.01);
  EXPECT_EQ(record.ending, Ending::kRefused);
  EXPECT_TRUE(record.actions.empty());
}

TEST(RunEpisode, RandomIsRepeatableAndNeverIllegal) {
  const auto task = sim::MakeTask("navigation");
  for (std::uint64_t seed = kFirstScene; seed < kFirstScene + 10; ++seed) {
    const auto first = MakeRandom();
    const auto second = MakeRandom();
    const EpisodeRecord a = RunEpisode(*task, *first, seed, 0.01);
    const EpisodeRecord b = RunEpisode(*task, *second, seed, 0.01);
    EXPECT_EQ(a.actions, b.actions);
    EXPECT_EQ(a.ending, b.ending);
    EXPECT_TRUE(a.ending == Ending::kSolved || a.ending == Ending::kFailed);
    EXPECT_NE(a.reason, "illegal action");
    EXPECT_EQ(a.ending == Ending::kSolved, a.reason.empty());
  }
}

// Not any possible action at each step: those would be second tries mostly, and lead nowhere.
TEST(RunEpisode, RandomIsABeginningOfALegalPlan) {
  const auto task = sim::MakeTask("stacking");
  const auto random = MakeRandom();
  for (std::uint64_t seed = kFirstScene; seed < kFirstScene + 4; ++seed) {
    const EpisodeRecord record = RunEpisode(*task, *random, seed, 0.01);
    task->Reset(seed);
    const auto plans = LegalPlans(*task, seed, 1000);
    const bool begins_one = std::any_of(plans.begin(), plans.end(), [&](const planner::Path& plan) {
      return record.actions.size() <= plan.size() &&
             std::equal(record.actions.begin(), record.actions.end(), plan.begin());
    });
    EXPECT_EQ(plans.size(), 12u);
    EXPECT_TRUE(begins_one) << "scene " << seed;
    EXPECT_NE(record.ending, Ending::kRefused);
  }
}

// A planner that may try things in the simulator first must do better than chance over a few
// scenes.
TEST(RunEpisode, PerfectImaginationBeatsChance) {
  const auto task = sim::MakeTask("navigation");
  planner::SearchParameters parameters;
  parameters.samples = 40;
  const auto informed = MakeSimulatorModel(1, parameters);
  const auto random = MakeRandom();
  int informed_solved = 0;
  int random_solved = 0;
  for (std::uint64_t seed = kFirstScene; seed < kFirstScene + 20; ++seed) {
    informed_solved += RunEpisode(*task, *informed, seed, 0.01).ending == Ending::kSolved;
    random_solved += RunEpisode(*task, *random, seed, 0.01).ending == Ending::kSolved;
  }
  EXPECT_GT(informed_solved, random_solved);
  EXPECT_GE(informed_solved, 10);
}

// With a goal nobody who keeps to the rules does anything else, and what is solved has the goal.
TEST(RunEpisode, DecidersKeepToTheGoal) {
  const auto task = sim::MakeTask("navigation");
  planner::SearchParameters parameters;
  parameters.samples = 20;
  int solved = 0;
  for (std::uint64_t seed = kFirstScene; seed < kFirstScene + 6; ++seed) {
    task->Reset(seed);
    const std::vector<int> there = task->LegalActions();
    const std::string wanted = task->spec().actions[there.back()].object;
    const Goal goal = planner::ParseGoal("visited(" + wanted + ")");
    for (const auto& decider : {MakeRandom(goal), MakeSimulatorModel(1, parameters, goal)}) {
      const EpisodeRecord record = RunEpisode(*task, *decider, seed, 0.01, goal);
      const auto& acts = record.actions;
      const bool visits = std::count(acts.begin(), acts.end(), there.back()) > 0;
      EXPECT_TRUE(record.ending != Ending::kSolved || visits) << seed;
      EXPECT_NE(record.reason, "goal not reached");
      solved += record.ending == Ending::kSolved;
    }
  }
  EXPECT_GT(solved, 3);
}

// Who succeeds at the task without the goal has failed.
TEST(RunEpisode, SuccessWithoutTheGoalIsAFailure) {
  const auto task = sim::MakeTask("navigation");
  const auto random = MakeRandom();
  int solved = 0;
  for (std::uint64_t seed = kFirstScene; seed < kFirstScene + 20 && solved < 2; ++seed) {
    const EpisodeRecord free = RunEpisode(*task, *random, seed, 0.01);
    if (free.ending != Ending::kSolved) continue;
    ++solved;
    std::string missed;
    for (const sim::ActionSpec& action : task->spec().actions) {
      const auto& acts = free.actions;
      if (std::count(acts.begin(), acts.end(), action.index) == 0) missed = action.object;
    }
    const EpisodeRecord bound =
        RunEpisode(*task, *random, seed, 0.01, planner::ParseGoal("visited(" + missed + ")"));
    EXPECT_EQ(bound.actions, free.actions);
    EXPECT_EQ(bound.ending, Ending::kFailed);
    EXPECT_EQ(bound.reason, "goal not reached");
  }
  EXPECT_GT(solved, 0);
}

}  // namespace
}  // namespace prospect::tools
