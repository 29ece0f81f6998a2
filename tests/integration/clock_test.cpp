// Wall clocks that jump by hours, forwards and backwards, while everything runs: they stamp
// messages, and nothing waits by them.

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "services/common/clock.h"
#include "tests/integration/support/deployment.h"
#include "tests/integration/support/stops_in_time.h"

namespace prospect::tests {
namespace {

/// While one lives, programs start with wall clocks that jump (support/jumping_clock.cpp).
class JumpingClocksForChildren {
 public:
  JumpingClocksForChildren() {
    setenv("LD_PRELOAD", PROSPECT_JUMPING_CLOCK, 1);
    // A build with sanitizers wants its own library to come first, or be told otherwise.
    setenv("ASAN_OPTIONS", "verify_asan_link_order=0", 1);
  }
  ~JumpingClocksForChildren() {
    unsetenv("LD_PRELOAD");
    unsetenv("ASAN_OPTIONS");
  }
};

// Which clocks the latest words of all processes show: hours from this one's.
void NoteHours(const Witness& witness, std::set<std::int64_t>* hours) {
  constexpr std::int64_t kHourUs = 3600'000'000LL;
  for (const auto& [id, health] : witness.health) {
    const std::int64_t ahead_us = health.utime - services::UtimeNow();
    hours->insert((ahead_us + (ahead_us > 0 ? kHourUs / 2 : -kHourUs / 2)) / kHourUs);
  }
}

TEST(JumpingClocks, AnEpisodeGoesOn) {
  const JumpingClocksForChildren clocks;
  Witness witness;
  Deployment deployment("jumping_episode");
  ASSERT_TRUE(deployment.Up(witness, 2));
  auto& executive = deployment.Executive({"--workers", "2"});
  std::set<std::int64_t> hours;
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000,
                            [&] { NoteHours(witness, &hours); }));
  EXPECT_TRUE(code == 0 || code == 4) << code;
  const nlohmann::json result = deployment.Result();
  for (const auto& search : result.at("searches")) {
    EXPECT_TRUE(search.at("converged").get<bool>());
    EXPECT_LT(search.at("seconds").get<double>(), 10);
  }
  // Nobody was taken for dead, or for alive, by a clock.
  for (const char* service : {"simulator", "model"})
    EXPECT_EQ(witness.Services(service).size(), 1u) << service;
  const auto both = [&] {
    NoteHours(witness, &hours);
    return hours.contains(-5) && hours.contains(7);
  };
  EXPECT_TRUE(witness.Until(both, 20000)) << "the clocks should have jumped";
}

TEST(JumpingClocks, TheRobotsStillStop) {
  const JumpingClocksForChildren clocks;
  {
    Witness witness;
    Deployment deployment("jumping_simulator");
    deployment.Simulator({"--frames-per-second", "4"});
    auto& executive = deployment.Executive({"--policy", "plan:0,1,2"});
    const auto under_way = [&] {
      return LatestStatusIs(witness, action_status_t::STATE_RUNNING) && !witness.labels.empty() &&
             witness.labels.rbegin()->second.frame >= 4;
    };
    ASSERT_TRUE(witness.Until(under_way, 15000));
    ExpectTheRobotStopsWithout(executive, witness);
  }
  Witness witness;
  Deployment deployment("jumping_example");
  Process robot("examples/example-robot", {"--bus", witness.bus.url()},
                deployment.folder + "/robot.log");
  // An action of the example lasts longer than the silence that stops it.
  auto& executive = deployment.Executive({"--no-reset", "--policy", "plan:0,8"});
  ASSERT_TRUE(witness.Until([&] { return LatestStatusIs(witness, action_status_t::STATE_RUNNING); },
                            20000));
  ExpectTheRobotStopsWithout(executive, witness);
}

}  // namespace
}  // namespace prospect::tests
