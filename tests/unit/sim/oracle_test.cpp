#include "sim/oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/unit/sim/scripted_task.h"

namespace prospect::sim {
namespace {

using Path = std::vector<int>;

TEST(Oracle, FindsTheOneGoodPlan) {
  const Path good = {2, 0, 3};
  ScriptedTask task([&](const Path& path, std::uint64_t) {
    return std::equal(path.begin(), path.end(), good.begin()) ? "" : "wrong";
  });
  const OracleResult result = ConsultOracle(task, 1);
  EXPECT_EQ(result.scene_class, SceneClass::kSolvable);
  EXPECT_EQ(result.best_plan, good);
  EXPECT_EQ(result.best_successes, 10);
  EXPECT_EQ(result.plans.size(), 24u);
  EXPECT_NEAR(result.random_failure_share(), 23.0 / 24, 1e-12);
  EXPECT_EQ(result.failures.at("wrong"), 23 * 3);
}

TEST(Oracle, HopelessIfNothingEverSucceeds) {
  ScriptedTask task([](const Path& path, std::uint64_t) { return path.size() < 3 ? "" : "late"; });
  const OracleResult result = ConsultOracle(task, 1);
  EXPECT_EQ(result.scene_class, SceneClass::kHopeless);
  EXPECT_EQ(result.plans.size(), 24u);
  EXPECT_EQ(result.failures.at("late"), 24 * 3);
}

// Successes in the rounds, few in the fresh runs: the noise seeds decide.
TEST(Oracle, DoubtfulInBetween) {
  int run = 0;
  ScriptedTask task([&](const Path& path, std::uint64_t) {
    if (path.size() < 3) return "";
    return ++run % 3 == 0 ? "" : "luck";
  });
  const OracleResult result = ConsultOracle(task, 1);
  EXPECT_EQ(result.scene_class, SceneClass::kDoubtful);
  EXPECT_LT(result.best_successes, 7);
}

TEST(Oracle, SevenOfTenIsSolvable) {
  for (int limit : {6, 7}) {
    int fresh = -24 * 3;  // complete plans of the rounds come first and all succeed
    ScriptedTask task([&](const Path& path, std::uint64_t) {
      if (path.size() < 3) return "";
      return fresh++ < limit ? "" : "luck";
    });
    const OracleResult result = ConsultOracle(task, 1);
    EXPECT_EQ(result.best_successes, limit);
    EXPECT_EQ(result.scene_class, limit == 7 ? SceneClass::kSolvable : SceneClass::kDoubtful);
  }
}

TEST(Oracle, SharesBeginningsAndUsesOneNoiseSeedARound) {
  std::set<std::uint64_t> seeds;
  ScriptedTask task([&](const Path&, std::uint64_t noise) {
    seeds.insert(noise);
    return "";
  });
  ConsultOracle(task, 9);
  EXPECT_EQ(task.starts, 3 * (4 + 12 + 24) + 10 * 3);
  EXPECT_EQ(seeds.size(), 3u + 10u);
  EXPECT_EQ(seeds.count(0), 0u);  // not the trial's own noise
}

TEST(Oracle, TriesOnlyWhatTheSceneOffers) {
  ScriptedTask task([](const Path& path, std::uint64_t) { return path[0] == 0 ? "first" : ""; },
                    {true, true, true, false});
  const OracleResult result = ConsultOracle(task, 1);
  EXPECT_EQ(result.plans.size(), 6u);
  EXPECT_EQ(result.failures.at("first"), 2 * 3);
  EXPECT_EQ(result.best_plan, (Path{1, 0, 2}));  // the first of equals
}

TEST(Oracle, LeavesTheTaskAsItWas) {
  ScriptedTask task([](const Path&, std::uint64_t) { return ""; });
  task.Reset(5);
  ConsultOracle(task, 1);
  EXPECT_EQ(task.progress().segment, -1);
  EXPECT_EQ(task.LegalActions().size(), 4u);
}

// Of plans that all succeed only those that end with 2 are wanted, and of their runs only some
// bring about what is wanted.
TEST(Oracle, NarrowedToWhatIsWanted) {
  ScriptedTask task([](const Path& path, std::uint64_t noise) {
    return path.size() == 3 && path[0] == 0 && noise % 2 ? "luck" : "";
  });
  const OracleResult all = ConsultOracle(task, 1);
  const auto ends_with_two = [](const Path& plan) { return plan.back() == 2; };
  for (int limit : {10, 7, 6, 0}) {
    int asked = 0;
    const auto reached = [&](const Task& at) {
      EXPECT_EQ(at.progress().action, 2);
      return asked++ < limit;
    };
    const OracleResult narrow = NarrowOracle(task, 1, all, ends_with_two, reached);
    EXPECT_EQ(asked, 10) << "each success is looked at";
    EXPECT_EQ(narrow.plans.size(), 6u);
    EXPECT_EQ(narrow.best_plan, (Path{1, 0, 2})) << "0 first sometimes fails";
    EXPECT_EQ(narrow.best_successes, limit);
    EXPECT_EQ(narrow.scene_class, limit >= 7 ? SceneClass::kSolvable : SceneClass::kDoubtful);
    EXPECT_EQ(task.progress().segment, -1) << "the task is as it was";
  }
  const OracleResult none = NarrowOracle(
      task, 1, all, [](const Path&) { return false; }, [](const Task&) { return true; });
  EXPECT_EQ(none.scene_class, SceneClass::kHopeless);
  EXPECT_EQ(none.success_frequency(), 0);
}

TEST(Oracle, RefusesZeroRounds) {
  ScriptedTask task([](const Path&, std::uint64_t) { return ""; });
  EXPECT_THROW(ConsultOracle(task, 1, {0, 10}), std::invalid_argument);
}

}  // namespace
}  // namespace prospect::sim
