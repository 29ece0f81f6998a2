// Processes killed in mid-search: the search goes on, counts stay exact, and what the dead had in
// flight is forgotten. How fast it goes on, as a ratio, is measured by
// tests/benchmarks/deaths.sh; here stand deadlines.

#include <gtest/gtest.h>
#include <signal.h>

#include <string>

#include "services/binding/request_window.h"
#include "services/common/clock.h"
#include "tests/faults/counts.h"
#include "tests/faults/watched_search.h"

namespace prospect::tests {
namespace {

using services::SteadyMs;

constexpr int kBudgetMs = 8000;
// So few that a busy machine makes them too, and none are made in a stall.
constexpr int kSomeRollouts = 8;

class Deaths : public testing::Test, protected WatchedSearch {
 protected:
  Deaths()
      : WatchedSearch(std::string("deaths_") +
                      testing::UnitTest::GetInstance()->current_test_info()->name()) {}
};

TEST_F(Deaths, AKilledWorkerIsForgottenAndItsRowsAreNot) {
  Server();
  Process& victim = Worker();
  for (int i = 0; i < 3; ++i) Worker();
  ASSERT_TRUE(Up(1, 4));
  const std::int64_t dead = IdOf("worker", victim.pid());
  ASSERT_NE(dead, 0);
  // On a busy machine the late one needs seconds to come up.
  Begin(4, 2 * kBudgetMs);
  ASSERT_TRUE(UnderWay());
  const auto dead_has_worked = [&] {
    const auto view = observer.View(dead);
    return view && view->announced.rollouts >= kSomeRollouts && view->announced.in_flight > 0;
  };
  ASSERT_TRUE(witness.Until(dead_has_worked, 5000));

  victim.Signal(SIGKILL);
  const std::int64_t killed_ms = SteadyMs();
  const std::int64_t before = observer.rollouts();
  const std::int64_t legacy = observer.View(dead)->announced.rollouts;
  // Who comes now never heard the dead one.
  Process& late = Worker();
  EXPECT_TRUE(witness.Until([&] { return observer.rollouts() > before + kSomeRollouts; }, 1000))
      << "the others stopped too";
  EXPECT_TRUE(witness.Until([&] { return !observer.View(dead)->live; }, 2 * services::kLeaseMs));
  EXPECT_LE(SteadyMs() - killed_ms, 2 * services::kLeaseMs);
  EXPECT_LE(observer.in_flight(), 4 * 2) << "the dead worker's rollouts still count";

  // It hears the dead one's rows from the others, and tells of them.
  ASSERT_TRUE(witness.Until([&] { return IdOf("worker", late.pid()) != 0; }, 5000));
  const std::int64_t heir = IdOf("worker", late.pid());
  EXPECT_TRUE(witness.Until([&] { return observer.Relayed(heir, dead) >= legacy; }, kBudgetMs))
      << observer.Relayed(heir, dead) << " of " << legacy;

  const auto search = End();
  ASSERT_FALSE(search.is_null()) << folder;
  EXPECT_EQ(search.at("ended_by"), "deadline");
  EXPECT_LT(search.at("seconds"), 2 * kBudgetMs / 1000.0 + 1);
  EXPECT_GE(search.at("workers"), 4);
}

TEST_F(Deaths, ANewModelServerTakesOverAndNothingIsCountedTwice) {
  Process& first = Server();
  for (int i = 0; i < 2; ++i) Worker();
  ASSERT_TRUE(Up(1, 2));
  Begin(2, kBudgetMs);
  ASSERT_TRUE(UnderWay());
  first.Signal(SIGKILL);
  ASSERT_EQ(first.Wait(5000), 128 + SIGKILL);
  Process& second = Server();
  ASSERT_TRUE(witness.Until([&] { return IdOf("model", second.pid()) != 0; }, 10000));
  const std::int64_t up_ms = SteadyMs();
  const std::int64_t server = IdOf("model", second.pid());
  EXPECT_TRUE(witness.Until([&] { return observer.FirstReplyMs(server) != 0; }, 1000))
      << "no evaluation within a second of the new server's first sign of life";
  const std::int64_t before = observer.rollouts();
  EXPECT_TRUE(witness.Until([&] { return observer.rollouts() > before + kSomeRollouts; }, 1500));
  RecordProperty("resumed_ms", static_cast<int>(observer.FirstReplyMs(server) - up_ms));

  const auto search = End();
  ASSERT_FALSE(search.is_null()) << folder;
  EXPECT_TRUE(search.at("converged"));
  EXPECT_EQ(search.at("evaluations"), observer.evaluated()) << "distinct paths";
  const auto counted = [&] {
    return RolloutsTold(witness) == search.at("rollouts").get<std::int64_t>();
  };
  EXPECT_TRUE(witness.Until(counted, 3000)) << "rollouts, once each by their writers";
}

TEST_F(Deaths, OneOfTwoServersIsMissedForNoLongerThanATimeout) {
  Process& victim = Server();
  Server();
  std::vector<int> pids;
  for (int i = 0; i < 2; ++i) pids.push_back(Worker().pid());
  ASSERT_TRUE(Up(2, 2));
  Begin(2, kBudgetMs);
  ASSERT_TRUE(UnderWay());
  victim.Signal(SIGKILL);
  const std::int64_t killed_ms = SteadyMs();
  witness.Listen(2500);
  for (const int pid : pids) {
    const std::int64_t stall = observer.LongestStallMs(IdOf("worker", pid), killed_ms, SteadyMs());
    EXPECT_LE(stall, services::RequestWindow::kLongestTimeoutMs);
  }
  EXPECT_FALSE(End().is_null()) << folder;
}

}  // namespace
}  // namespace prospect::tests
